#include "core/path/subpath.h"

#include "core/path/numbers.h"

namespace pssmlt {
SubpathTracer::SubpathTracer(const Scene& scene, const PathLimits& limits, Mis mis)
    : scene_(scene), limits_(limits), mis_(mis) {
  // The vertex past the last scattering one only serves to meet a light.
  const bool hittable = scene.features().area_lights || scene.features().infinite_lights;
  camera_vertices_ = limits.max_bounces + (hittable ? 1 : 0);
}

void SubpathTracer::from_camera(PrimarySample& u, Subpath& path) const {
  path.clear();
  const Camera& camera = scene_.camera();
  const dvec2 raster = u.raster();
  const vec2 lens = lens_numbers(u);
  const auto start = camera.emit(lens, raster);
  if (!start) return;
  path.start = *start;
  path.started = true;
  path.traits = camera.traits();
  walk(u, {Stream::camera, Transport::radiance, camera, false, camera_vertices_},
       limits_.paths.from_camera(), path);
}

void SubpathTracer::from_light(PrimarySample& u, Subpath& path) const {
  path.clear();
  const EmissionNumbers n = emission_numbers(u);
  const auto choice = scene_.lights().choose(n.choice);
  if (!choice.light) return;
  const auto start = choice.light->emit(n.position, dvec2(n.direction));
  if (!start) return;
  path.start = *start;
  path.started = true;
  path.light = choice.light;
  path.probability = choice.probability;
  path.traits = choice.light->traits();
  if (path.traits.infinite) path.start.from.normal = path.start.direction;
  const bool hittable = !path.traits.delta_position && !path.traits.delta_direction;
  walk(u, {Stream::light, Transport::importance, *choice.light, hittable, limits_.max_bounces},
       limits_.paths.from_light(light_letter(path.traits)), path);
}

// The endpoint's density counts with the probability of choosing it, in both strategies alike.
MisPartial SubpathTracer::first_mis(const Side& side, const Subpath& path, const PathVertex& v,
                                    float cos_vertex) const {
  const Emission& e = path.start;
  const double p = static_cast<double>(path.probability);
  const double connect =
      static_cast<double>(side.endpoint.pdf_toward(v.surface.hit.position, e.from));
  const double emit = static_cast<double>(e.pdf_position) * static_cast<double>(e.pdf_direction);
  return mis_.first(p * connect, p * emit, static_cast<double>(e.cosine),
                    static_cast<double>(cos_vertex), side.hittable);
}

void SubpathTracer::walk(PrimarySample& u, const Side& side, PathExpression::State state,
                         Subpath& path) const {
  const SceneFeatures& features = scene_.features();
  const Emission& start = path.start;
  Walk w;
  w.ray = {offset_origin(start.from.position, start.error, start.from.normal, start.direction),
           start.direction, infinity};
  w.throughput = start.weight() / path.probability;
  w.begin = max_component(w.throughput);
  w.state = state;
  if (!(w.begin > 0.f)) return;
  for (int k = 1; k <= side.max_vertices; ++k) {
    PathVertex& v = path.push();
    const float alpha = alpha_number(u, side.stream, k - 1, features);
    if (!scene_.intersect(w.ray, alpha, v.surface.hit)) {
      path.pop();
      if (side.camera()) path.escape = escape(w, path, k);
      return;
    }
    const float cos_vertex = std::abs(glm::dot(v.surface.hit.ng, w.ray.direction));
    if (!(cos_vertex > 0.f)) return path.pop();
    v.surface.wo = -w.ray.direction;
    v.throughput = w.throughput;
    v.state = w.state;
    v.mis = k == 1 ? first_mis(side, path, v, cos_vertex) : next_mis(w, path, k, cos_vertex);
    v.connectible = false;
    if (k > limits_.max_bounces) return;
    const MaterialNumbers m = material_numbers(u, side.stream, k, features);
    if (!v.surface.shade(scene_, v.surface.wo, m)) return;
    v.connectible = v.surface.connectible();
    v.joined_state = step(side, w.state, false);
    if (k == side.max_vertices || !scatter(u, side, v.surface, k, w)) return;
  }
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
  w.cosine = std::abs(glm::dot(surface.hit.ng, s->wi));
  w.ray = surface.spawn(s->wi);
  return side.camera() ? !limits_.paths.camera_dead(w.state) : !limits_.paths.light_dead(w.state);
}

MisPartial SubpathTracer::next_mis(const Walk& w, const Subpath& path, int k,
                                   float cos_vertex) const {
  const vec3 edge = path.position(k) - path.position(k - 1);
  return mis_.next(path[k - 1].mis, static_cast<double>(w.pdf), static_cast<double>(w.pdf_reverse),
                   w.delta, static_cast<double>(w.cosine), static_cast<double>(cos_vertex),
                   static_cast<double>(length_squared(edge)));
}

// The camera subpath's edge k left the scene: its end is a direction, density per solid angle.
Escape SubpathTracer::escape(const Walk& w, const Subpath& path, int k) const {
  Escape out{k - 1, w.ray.direction, w.throughput, {}, w.state};
  if (k > 1) {
    out.mis =
        mis_.next(path[k - 1].mis, static_cast<double>(w.pdf), static_cast<double>(w.pdf_reverse),
                  w.delta, static_cast<double>(w.cosine), 1.0, 1.0);
  }
  return out;
}

}  // namespace pssmlt
