#include "core/path/bidirectional.h"

#include <cmath>

#include "core/path/dispersion.h"
#include "core/path/flight.h"
#include "core/path/sensor_draw.h"
#include "core/path/strategies.h"

namespace pssmlt {
namespace {

constexpr std::string_view heuristics[] = {"balance", "power"};

double as_double(float x) { return static_cast<double>(x); }

// Density with which the endpoint's emission samples the vertex, over that of drawing the endpoint
// from there (`drawn`); the length of the edge cancels. arrival: Surface::arrival() of the vertex.
double emitted_over_drawn(const Toward& t, float arrival, float drawn) {
  return as_double(t.pdf_position) * as_double(t.pdf_direction) * as_double(arrival) /
         (as_double(t.cosine) * as_double(drawn));
}

// Of the path's wavelength, if it has one.
Rgb colour(bool dispersed, PrimarySample& u) {
  return dispersed ? path_wavelength(u).colour : Rgb(1.f);
}

}  // namespace

Bidirectional::Bidirectional(Parameters& p)
    : limits_(p),
      // Balance has the smaller error at equal time on the scenes of this project, by 1 to 10 %.
      mis_(p.choice("heuristic", "balance", heuristics,
                    "weights of the strategies (Veach 1997, "
                    "section 9.2)") == "power"
               ? Mis::Heuristic::power
               : Mis::Heuristic::balance),
      near_(read_light_pick(p)),
      far_(near_ == LightPick::bvh ? LightPick::power : near_) {}

void Bidirectional::prepare(const Scene& scene) {
  scene_ = &scene;
  tracer_ = std::make_unique<SubpathTracer>(scene, limits_, mis_, far_);
  // Without a surface that can be joined, light subpaths only serve to show the lamps themselves,
  // which the camera subpath does better.
  light_side_ = scene.features().connectible && !scene.lights().empty();
  sensor_ = scene.camera().bare() && !scene.lights().empty();
  lamps_to_lens_ = !sensor_ && light_side_ && scene.features().area_lights;
}

std::string Bidirectional::sees() const {
  const std::string common =
      strategy::any_of({strategy::hit_light, strategy::next_event, strategy::join, strategy::lens,
                        strategy::light_to_lens});
  return sensor_ ? strategy::any_of({common.c_str(), strategy::sensor_draw}) : common;
}

void Bidirectional::hit_at(const Subpath& camera, int k, PrimarySample& u, Splats& out) const {
  const Surface& s = camera[k].surface;
  if (s.in_medium()) return meet_medium(camera, k, u, out);
  const Light* const light = s.hit.primitive->light;
  if (!light || s.emerging()) return;
  hit(camera, k - 1, *light, s.light_point(), scene_->emitted(s.hit, s.wo), u, out);
}

void Bidirectional::hit_beyond(const Subpath& camera, PrimarySample& u, Splats& out) const {
  const Escape& escape = camera.escape;
  if (escape.bounces < 0) return;
  EndpointPoint at;
  at.normal = -escape.direction;
  for (const Light* light : scene_->lights().infinite()) {
    hit(camera, escape.bounces, *light, at, light->background(escape.direction), u, out);
  }
}

// Light that a medium emits at a camera subpath's vertex; no other strategy makes it.
void Bidirectional::meet_medium(const Subpath& camera, int k, PrimarySample& u, Splats& out) const {
  const PathVertex& v = camera[k];
  const Strategy st{0, k + 1};
  const Rgb& emission = v.surface.point().emission;
  if (is_black(emission) || !wants(st)) return;
  if (!limits_.paths.ends(LightLetter::medium, v.state)) return;
  out.camera(colour(camera.dispersed_before(k), u) * v.throughput * emission, st.tag());
}

// The subpath's vertex bounces + 1 lies on the light (or is its escape), which emits `value`.
void Bidirectional::hit(const Subpath& camera, int bounces, const Light& light,
                        const EndpointPoint& at, Rgb value, PrimarySample& u, Splats& out) const {
  const Strategy st{0, bounces + 2};
  if (!wants(st) || is_black(value)) return;
  const EndpointTraits traits = light.traits();
  const bool infinite = traits.infinite;
  const PathVertex* const v = infinite ? nullptr : &camera[bounces + 1];
  if (!limits_.paths.ends(light_letter(traits), v ? v->state : camera.escape.state)) return;
  const MisPartial& mis = v ? v->mis : camera.escape.mis;
  const vec3 direction = v ? v->surface.wo : -camera.escape.direction;
  const double p = as_double(scene_->lights().probability(&light));
  const EmissionValue e = light.evaluate(at, direction);
  const Rgb& throughput = v ? v->throughput : camera.escape.throughput;
  if (bounces == 0 && sensor_) {
    // Against the same light drawn for the camera's point; what media absorb counts in neither.
    const LightReceiver sensor = sensor_receiver(camera.start);
    const double drawn = as_double(scene_->lights().probability(near_, sensor, &light)) *
                         as_double(light.pdf_toward(sensor.position, at));
    const double ratio = mis_.f(drawn / as_double(camera.start.pdf_direction));
    return out.camera(weight(0.0, ratio) * throughput * value, st.tag());
  }
  double connect = 0.0;
  if (bounces == 0) {
    // Only s = t = 1 could have made this path, with a point drawn as for emission.
    connect = lamps_to_lens_ && v ? p * as_double(e.pdf_position) : 0.0;
  } else if (mis.connect > 0.0) {
    const Surface& last = camera[bounces].surface;
    const vec3& from = last.hit.position;
    const LightPick pick = pick_for(camera[bounces]);
    const LightReceiver receiver = light_receiver(*scene_, pick, last);
    connect = as_double(scene_->lights().probability(pick, receiver, &light)) *
              as_double(light.pdf_toward(from, at));
    if (v) {
      connect *= as_double(std::abs(glm::dot(v->surface.hit.ng, direction))) /
                 as_double(length_squared(at.position - from));
    }
  }
  const double emit = p * as_double(e.pdf_position) * as_double(e.pdf_direction);
  value *= colour(camera.dispersed_before(bounces + 1), u);
  out.camera(weight(0.0, mis_.on_light(mis, connect, emit)) * throughput * value, st.tag());
}

void Bidirectional::draw_light(const Subpath& camera, int k, PrimarySample& u, Splats& out) const {
  if (camera[k].connectible) draw_light_from(camera[k], {1, k + 1}, u, out);
}

void Bidirectional::draw_light_from(const PathVertex& x, Strategy st, PrimarySample& u,
                                    Splats& out) const {
  if (!wants(st)) return;
  const Surface& surface = x.surface;
  const LightDraw draw(*scene_, pick_for(x), surface, light_numbers(u, st.t - 1));
  if (!draw.succeeded() || !limits_.paths.ends(draw.letter(), x.joined_state)) return;
  const Toward& t = draw.toward();
  const auto scattering = surface.scattering(t.wi, Transport::radiance);
  const Rgb value = x.throughput * scattering.f_cos * t.value / draw.pdf();
  if (is_black(value)) return;
  const Passage way = passage(*scene_, surface.segment(t), surface.medium_toward(t.wi));
  if (!(way.visibility > 0.f)) return;
  const float met = scattering.pdf * mean(way.transmittance);
  const double light_side = draw.hittable() ? mis_.f(as_double(met) / as_double(draw.pdf())) : 0.0;
  const double emit = as_double(draw.emitted_over_drawn()) *
                      emitted_over_drawn(t, surface.arrival(t.wi, way.transmittance), t.pdf_toward);
  const double camera_side =
      light_side_ ? mis_.join(x.mis, emit, as_double(scattering.pdf_reverse)) : 0.0;
  out.camera(weight(light_side, camera_side) * way.light() * colour(x.dispersed, u) * value,
             st.tag());
}

// s = t = 1, for cameras that are bare surfaces.
void Bidirectional::draw_light_for_sensor(const Subpath& camera, PrimarySample& u,
                                          Splats& out) const {
  const Strategy st{1, 1};
  if (!camera.started || !wants(st)) return;
  const SensorDraw draw(*scene_, near_, camera.start, camera.time, light_numbers(u, 0));
  if (!draw.succeeded()) return;
  if (!limits_.paths.ends(draw.letter(), limits_.paths.from_camera())) return;
  const Passage way = draw.way();
  if (!(way.visibility > 0.f)) return;
  const double met = mis_.f(as_double(draw.met()) / as_double(draw.pdf()));
  out.camera(weight(met, 0.0) * way.light() * draw.value(), st.tag());
}

// s = t = 1: the light itself as the lens sees it.
void Bidirectional::lens_from_light(const Subpath& light, PrimarySample& u, Splats& out) const {
  const Strategy st{1, 1};
  const EndpointTraits& traits = light.traits;
  if (!lamps_to_lens_ || !wants(st) || light_letter(traits) != LightLetter::area) return;
  const PathExpression& paths = limits_.paths;
  if (!paths.ends(LightLetter::area, paths.from_camera())) return;
  const EndpointPoint& at = light.start.from;
  const auto lens = scene_->camera_toward(at.position, lens_connection_numbers(u, 0), light.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const EmissionValue e = light.emitted(lens->wi);
  const float drawn = light.probability * light.start.pdf_position * lens->pdf_toward;
  const Rgb value = e.value * lens->value * (e.cosine / drawn);
  if (is_black(value)) return;
  const Ray ray = Scene::segment(at.position, light.start.error, at.normal, lens->at.position,
                                 lens->error, lens->at.normal, light.time);
  const Passage way = passage(*scene_, ray, scene_->light_medium(*light.light, at, lens->wi));
  // The other strategy: a camera ray meets the light.
  const double met = emitted_over_drawn(*lens, e.cosine * mean(way.transmittance), drawn);
  out.light(lens->raster, weight(mis_.f(met), 0.0) * way.light() * value, st.tag());
}

// t = 1: a light subpath's vertex as the lens sees it.
void Bidirectional::lens_from(const Subpath& light, int k, PrimarySample& u, Splats& out) const {
  const PathVertex& y = light[k];
  const Strategy st{k + 1, 1};
  if (!y.connectible || !wants(st)) return;
  const PathExpression& paths = limits_.paths;
  if (!paths.joins(y.joined_state, paths.from_camera())) return;
  const Surface& surface = y.surface;
  const auto lens = scene_->camera_toward(surface.hit.position,
                                          lens_connection_numbers(u, st.s - 1), surface.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const auto scattering = surface.scattering(lens->wi, Transport::importance);
  const Rgb value = y.throughput * scattering.f_cos * lens->value / lens->pdf_toward;
  if (is_black(value)) return;
  const Passage way = passage(*scene_, surface.segment(*lens), surface.medium_toward(lens->wi));
  if (!(way.visibility > 0.f)) return;
  const double emit =
      emitted_over_drawn(*lens, surface.arrival(lens->wi, way.transmittance), lens->pdf_toward);
  const double light_side =
      mis_.join(partial_at_lens(light, k), emit, as_double(scattering.pdf_reverse));
  out.light(lens->raster, weight(light_side, 0.0) * way.light() * colour(y.dispersed, u) * value,
            st.tag());
}

// The light's first vertex, seen from the lens, is one for which a camera subpath draws lights by
// near_; everywhere else the vertex beside the light has a joined one between it and the lens.
MisPartial Bidirectional::partial_at_lens(const Subpath& light, int k) const {
  MisPartial partial = light[k].mis;
  const LightTable& lights = scene_->lights();
  if (k > 1 || near_ == far_ || !lights.by_place(near_)) return partial;
  const LightReceiver at = light_receiver(*scene_, near_, light[k].surface);
  const double far = as_double(lights.probability(far_, at, light.light));
  partial.connect *= mis_.f(as_double(lights.probability(near_, at, light.light)) / far);
  return partial;
}

void Bidirectional::join(const Subpath& camera, int k, const Subpath& light, int j, float factor,
                         PrimarySample& u, Splats& out) const {
  const PathVertex &x = camera[k], &y = light[j];
  const Strategy st{j + 1, k + 1};
  if (!x.connectible || !y.connectible || !wants(st)) return;
  if (!limits_.paths.joins(y.joined_state, x.joined_state)) return;
  const vec3 edge = y.surface.hit.position - x.surface.hit.position;
  const float distance2 = length_squared(edge);
  if (!(distance2 > 0.f)) return;
  const vec3 to_y = edge / std::sqrt(distance2);
  const vec3 to_x = -to_y;
  const auto at_camera = x.surface.scattering(to_y, Transport::radiance);
  if (is_black(at_camera.f_cos)) return;
  const auto at_light = y.surface.scattering(to_x, Transport::importance);
  const Rgb value =
      x.throughput * at_camera.f_cos * at_light.f_cos * y.throughput * (factor / distance2);
  if (is_black(value)) return;
  const Passage way = passage(*scene_, x.surface.segment(y.surface), x.surface.medium_toward(to_y));
  if (!(way.visibility > 0.f)) return;
  const double d2 = as_double(distance2);
  // Densities per area, in media per volume, of each vertex as sampled from the other side.
  const Rgb& passed = way.transmittance;
  const double at_y = as_double(at_camera.pdf) * as_double(y.surface.arrival(to_y, passed)) / d2;
  const double at_x = as_double(at_light.pdf) * as_double(x.surface.arrival(to_x, passed)) / d2;
  const double light_side = mis_.join(y.mis, at_y, as_double(at_light.pdf_reverse));
  const double camera_side = mis_.join(x.mis, at_x, as_double(at_camera.pdf_reverse));
  out.camera(
      weight(light_side, camera_side) * way.light() * colour(x.dispersed || y.dispersed, u) * value,
      st.tag());
}

}  // namespace pssmlt
