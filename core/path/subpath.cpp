#include "core/path/subpath.h"

#include "core/path/flight.h"
#include "core/path/way_beneath.h"
#include "core/path/witness.h"

namespace pssmlt {
SubpathTracer::SubpathTracer(const Scene& scene, const PathLimits& limits, Mis mis, LightPick pick)
    : scene_(scene), limits_(limits), mis_(mis), pick_(pick) {
  // The vertex past the last scattering one only serves to meet a light.
  const SceneFeatures& f = scene.features();
  const bool hittable = f.area_lights || f.infinite_lights || f.emitting_media;
  camera_vertices_ = limits.max_bounces + (hittable ? 1 : 0);
}

void SubpathTracer::from_camera(PrimarySample& u, Subpath& path, int most) const {
  path.clear();
  const dvec2 raster = u.raster();
  const vec2 lens = lens_numbers(u);
  path.time = time_number(u, scene_);
  const auto start = scene_.camera_emit(lens, raster, path.time);
  if (!start) return;
  path.start = *start;
  path.started = true;
  path.traits = scene_.camera().traits();
  walk(u, {Stream::camera, Transport::radiance, nullptr, false, std::min(most, camera_vertices_)},
       limits_.paths.from_camera(), path);
}

void SubpathTracer::from_light(PrimarySample& u, Subpath& path, int most) const {
  path.clear();
  const EmissionNumbers n = emission_numbers(u);
  path.time = time_number(u, scene_);
  const auto choice = scene_.lights().choose(n.choice);
  if (!choice.light) return;
  const auto start = choice.light->emit(n.position, dvec2(n.direction));
  if (!start) return;
  if (Witness* const w = Witness::here()) [[unlikely]]
    w->look_at(start->weight(), *choice.light);
  path.start = *start;
  path.started = true;
  path.light = choice.light;
  path.probability = choice.probability;
  path.traits = choice.light->traits();
  if (path.traits.infinite) path.start.from.normal = path.start.direction;
  walk(u,
       {Stream::light, Transport::importance, choice.light, path.traits.hittable(),
        std::min(most, limits_.max_bounces)},
       limits_.paths.from_light(light_letter(path.traits)), path);
}

// A light's densities count with the probability of choosing it: to emit, and to be drawn from the
// vertex, which has been shaded.
MisPartial SubpathTracer::first_mis(const Side& side, const Subpath& path, const PathVertex& v,
                                    const Rgb& transmittance) const {
  const Emission& e = path.start;
  const vec3& reference = v.surface.hit.position;
  double connect = 0.0, chosen = 1.0;
  if (side.light) {
    const LightReceiver at = light_receiver(scene_, pick_, v.surface);
    chosen = static_cast<double>(path.probability);
    connect = static_cast<double>(scene_.lights().probability(pick_, at, side.light)) *
              static_cast<double>(side.light->pdf_toward(reference, e.from));
  } else {
    connect = static_cast<double>(scene_.camera_pdf_toward(reference, e.from, path.time));
  }
  const double emit = static_cast<double>(e.pdf_position) * static_cast<double>(e.pdf_direction);
  return mis_.first(connect, chosen * emit, static_cast<double>(e.cosine),
                    static_cast<double>(v.surface.arrival(v.surface.wo, transmittance)),
                    side.hittable ? static_cast<double>(mean(transmittance)) : 0.0);
}

SubpathTracer::Walk SubpathTracer::begin(const Side& side, const Subpath& path) const {
  const Emission& start = path.start;
  Walk w;
  w.ray = leaving(start, path.time);
  w.medium = side.camera() ? scene_.camera_medium()
                           : scene_.light_medium(*path.light, start.from, start.direction);
  w.throughput = start.weight() / path.probability;
  w.begin = max_component(w.throughput);
  return w;
}

void SubpathTracer::walk(PrimarySample& u, const Side& side, PathExpression::State state,
                         Subpath& path) const {
  Walk w = begin(side, path);
  w.state = state;
  if (!(w.begin > 0.f)) return;
  for (int k = 1; k <= side.max_vertices; ++k) {
    const bool emerges = w.beneath != nullptr;
    if (emerges ? !emerge(k, w, path) : !advance(u, side, k, w, path)) return;
    PathVertex& v = path[k];
    if (k > limits_.max_bounces) return;
    const MaterialNumbers m = material_numbers(u, side.stream, k, scene_.features());
    if (!emerges && !v.surface.shade(scene_, v.surface.wo, m)) return;
    if (k == 1 && !side.camera()) v.mis = first_mis(side, path, v, w.transmittance);
    v.connectible = v.surface.connectible();
    v.dispersed |= v.surface.disperses(scene_);
    v.joined_state = step(side, w.state, false);
    if (k == side.max_vertices || !scatter(u, side, v.surface, k, w)) return;
  }
}

bool SubpathTracer::advance(PrimarySample& u, const Side& side, int k, Walk& w,
                            Subpath& path) const {
  PathVertex& v = path.push();
  Flight flight;
  const EdgeNumbers edge = edge_numbers(u, side.stream, k - 1, scene_.features());
  const Arrival arrival = fly(scene_, w.ray, w.medium, edge, v.surface, flight);
  const vec3 back = -w.ray.direction;
  if (scene_.features().media && arrival != Arrival::absorbed) {
    w.transmittance = flight.transmittance;
    w.throughput *= flight.weight();
  }
  if (arrival == Arrival::nothing && side.camera()) path.escape = escape(w, path, k);
  const float reach = arrival == Arrival::surface || arrival == Arrival::medium
                          ? v.surface.arrival(back, w.transmittance)
                          : 0.f;
  if (!(reach > 0.f)) {
    path.pop();
    return false;
  }
  v.surface.wo = back;
  v.throughput = w.throughput;
  v.state = w.state;
  if (k > 1) {
    v.mis = next_mis(w, path[k - 1], reach,
                     length_squared(v.surface.hit.position - path.position(k - 1)));
  } else if (side.camera()) {
    v.mis = first_mis(side, path, v, w.transmittance);
  }
  v.connectible = false;
  v.mirrored = w.mirrored;
  v.dispersed = path.dispersed_before(k);
  return true;
}

bool SubpathTracer::emerge(int k, Walk& w, Subpath& path) const {
  PathVertex& v = path.push();
  const PathVertex& from = path[k - 1];
  const Rgb factor = go_beneath(scene_, from.surface, *w.beneath, w.numbers, w.pdf, v.surface);
  w.beneath = nullptr;
  if (is_black(factor)) {
    path.pop();
    return false;
  }
  w.throughput *= factor;
  v.throughput = w.throughput;
  v.state = w.state;
  v.mis = mis_.beneath(from.mis, static_cast<double>(w.pdf), static_cast<double>(w.pdf_reverse));
  v.connectible = false;
  v.mirrored = w.mirrored;
  v.dispersed = path.dispersed_before(k);
  return true;
}

PathExpression::State SubpathTracer::step(const Side& side, PathExpression::State s,
                                          bool delta) const {
  return side.camera() ? limits_.paths.camera_step(s, delta) : limits_.paths.light_step(s, delta);
}

// Chooses the next direction at surface vertex k; false where the subpath ends.
bool SubpathTracer::scatter(PrimarySample& u, const Side& side, const Surface& surface, int k,
                            Walk& w) const {
  const ScatterNumbers n = scatter_numbers(u, side.stream, k);
  const auto s = surface.sample(n.lobe, n.direction, side.mode);
  if (!s || is_black(s->weight) || !(s->pdf > 0.f)) return false;
  w.throughput *= s->weight;
  // Radiance is compressed where it enters a denser medium and expands again where it leaves;
  // roulette looks through that. Importance is not.
  if (side.camera() && s->transmitted) w.eta_squared *= s->eta * s->eta;
  const float q = survival(k, max_component(w.throughput) * w.eta_squared / w.begin);
  if (q < 1.f && !(n.roulette < q)) return false;
  w.throughput /= q;
  w.state = step(side, w.state, s->delta);
  w.pdf = s->pdf;
  w.pdf_reverse = s->pdf_reverse;
  w.delta = s->delta;
  w.mirrored &= s->delta && !s->beneath;
  w.beneath = s->beneath;
  if (s->beneath) w.numbers = n;
  w.ray = surface.spawn(s->wi);
  w.medium = surface.medium_toward(s->wi);
  return side.camera() ? !limits_.paths.camera_dead(w.state) : !limits_.paths.light_dead(w.state);
}

MisPartial SubpathTracer::next_mis(const Walk& w, const PathVertex& from, float cos_end,
                                   float distance2) const {
  const float cos_start = from.surface.arrival(w.ray.direction, w.transmittance);
  return mis_.next(from.mis, static_cast<double>(w.pdf), static_cast<double>(w.pdf_reverse),
                   w.delta, static_cast<double>(cos_start), static_cast<double>(cos_end),
                   static_cast<double>(distance2));
}

// The camera subpath's edge k left the scene: its end is a direction, density per solid angle. The
// vertex that was pushed for its end is still there.
Escape SubpathTracer::escape(const Walk& w, const Subpath& path, int k) const {
  Escape out{k - 1, w.ray.direction, w.throughput, {}, w.state};
  if (k > 1) out.mis = next_mis(w, path[k - 1], mean(w.transmittance), 1.f);
  return out;
}

}  // namespace pssmlt
