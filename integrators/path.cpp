// Path tracing (Kajiya 1986) with next event estimation, both ways of finding a light combined by
// multiple importance sampling (Veach 1997, chapter 9, power heuristic), and Russian roulette from
// the third vertex on. Good where most light comes from lamps that the surfaces see; noisy for
// caustics and for light through small openings; blind to point, spot and distant lights seen
// through specular surfaces only (and to nothing else that bdpt sees).

#include <utility>

#include "core/integrator.h"
#include "core/path/dispersion.h"
#include "core/path/flight.h"
#include "core/path/light_draw.h"
#include "core/path/mis.h"
#include "core/path/sensor_draw.h"
#include "core/path/strategies.h"
#include "core/path/surface.h"
#include "core/path/way_beneath.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Path final : public Integrator {
 public:
  static constexpr const char* summary =
      "path tracing with next event estimation and multiple importance sampling (Kajiya 1986)";

  explicit Path(Parameters& p) : limits_(p), pick_(read_light_pick(p)) {}

  void prepare(const Scene& scene) override {
    scene_ = &scene;
    const SceneFeatures& f = scene.features();
    hittable_ = f.area_lights || f.infinite_lights || f.emitting_media;
    next_event_ = f.connectible && !scene.lights().empty();
    sensor_ = scene.camera().bare() && !scene.lights().empty();
  }
  std::string sees() const override {
    if (sensor_)
      return strategy::any_of({strategy::hit_light, strategy::next_event, strategy::sensor_draw});
    return strategy::any_of({strategy::hit_light, strategy::next_event});
  }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  // Where the path stands: the ray to trace and what came before it.
  struct Walk {
    Ray ray;
    const Medium* medium = nullptr;  // where the ray starts
    LightReceiver last;              // last vertex
    Rgb throughput{1.f};
    float pdf = 0.f;          // of the ray's direction [1/sr]; 0: no light could have been drawn
    float eta_squared = 1.f;  // product of squared index ratios, which roulette looks through
    int bounces = 0;
    bool dispersed = false;  // the path has a wavelength
    bool emerges = false;    // instead of following the ray it has come out from beneath a surface
    PathExpression::State state = 0;
  };
  void add_emission(const Walk& w, const Hit& hit, Splats& out) const;
  void add_medium_emission(const Walk& w, const Surface& s, Splats& out) const;
  void add_background(const Walk& w, Splats& out) const;
  void add_to_sensor(const Emission& start, Walk& w, PrimarySample& u, Splats& out) const;
  void add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const;
  bool follow(Walk& w, Surface& s, PrimarySample& u, Splats& out) const;
  bool scatter(Walk& w, Surface& s, PrimarySample& u) const;
  void take_wavelength(Walk& w, const Surface& s, PrimarySample& u) const;
  void add(const Walk& w, const Light& light, const EndpointPoint& at, const Rgb& value,
           Splats& out) const;

  PathLimits limits_;
  LightPick pick_;
  const Scene* scene_ = nullptr;
  bool hittable_ = false;    // there are lights that rays can meet
  bool next_event_ = false;  // there are lights to draw and surfaces that can be lit by the draw
  bool sensor_ = false;      // lights are drawn for the camera's own points
};

void Path::sample(PrimarySample& u, Splats& out, Workspace&) const {
  const SceneFeatures& features = scene_->features();
  const dvec2 raster = u.raster();
  const float time = time_number(u, *scene_);
  const auto start = scene_->camera_emit(lens_numbers(u), raster, time);
  if (!start) return;
  Walk w;
  w.throughput = start->weight();
  w.ray = leaving(*start, time);
  w.state = limits_.paths.from_camera();
  w.medium = scene_->camera_medium();
  if (sensor_) add_to_sensor(*start, w, u, out);
  Surface s;
  for (;;) {
    const bool emerges = std::exchange(w.emerges, false);
    if (!emerges && !follow(w, s, u, out)) return;
    if (w.bounces == limits_.max_bounces) return;
    ++w.bounces;
    const MaterialNumbers m = material_numbers(u, Stream::camera, w.bounces, features);
    if (!emerges && !s.shade(*scene_, -w.ray.direction, m)) return;
    if (features.dispersion) take_wavelength(w, s, u);
    if (next_event_ && s.connectible()) add_direct(w, s, u, out);
    if (w.bounces == limits_.max_bounces && !hittable_) return;
    if (!scatter(w, s, u)) return;
  }
}

// Follows the ray to the next vertex and adds the light it meets; false if there is none.
inline bool Path::follow(Walk& w, Surface& s, PrimarySample& u, Splats& out) const {
  Flight flight;
  const EdgeNumbers edge = edge_numbers(u, Stream::camera, w.bounces, scene_->features());
  const Arrival arrival = fly(*scene_, w.ray, w.medium, edge, s, flight);
  if (arrival == Arrival::absorbed) return false;
  if (scene_->features().media) {
    w.throughput *= flight.weight();
    w.pdf *= mean(flight.transmittance);
  }
  if (arrival == Arrival::nothing) {
    add_background(w, out);
    return false;
  }
  if (arrival == Arrival::medium) {
    add_medium_emission(w, s, out);
  } else if (s.hit.primitive->light) {
    add_emission(w, s.hit, out);
  }
  return true;
}

// From the first surface on that asks for it.
void Path::take_wavelength(Walk& w, const Surface& s, PrimarySample& u) const {
  if (w.dispersed || !s.disperses(*scene_)) return;
  w.dispersed = true;
  w.throughput *= path_wavelength(u).colour;
}

// Light that the path met, weighted against having drawn the same point of the light.
void Path::add(const Walk& w, const Light& light, const EndpointPoint& at, const Rgb& value,
               Splats& out) const {
  if (is_black(value) || w.bounces < limits_.min_bounces) return;
  if (!limits_.paths.ends(light_letter(light.traits()), w.state)) return;
  float weight = 1.f;
  if (w.pdf > 0.f) {
    const float drawn =
        scene_->lights().probability(pick_, w.last, &light) * light.pdf_toward(w.last.position, at);
    weight = power_weight(w.pdf, drawn);
  }
  const auto bounces = static_cast<uint32_t>(w.bounces);
  out.camera(weight * w.throughput * value,
             {bounces, 0, static_cast<uint8_t>(std::min(w.bounces + 2, 255))});
}

void Path::add_emission(const Walk& w, const Hit& hit, Splats& out) const {
  add(w, *hit.primitive->light, {hit.position, hit.ng, hit.uv, hit.element},
      scene_->emitted(hit, -w.ray.direction), out);
}

// Light that the medium itself sends toward the path; nothing else finds it.
void Path::add_medium_emission(const Walk& w, const Surface& s, Splats& out) const {
  if (is_black(s.point().emission) || w.bounces < limits_.min_bounces) return;
  if (!limits_.paths.ends(LightLetter::medium, w.state)) return;
  out.camera(
      w.throughput * s.point().emission,
      {static_cast<uint32_t>(w.bounces), 0, static_cast<uint8_t>(std::min(w.bounces + 2, 255))});
}

void Path::add_background(const Walk& w, Splats& out) const {
  EndpointPoint at;
  at.normal = -w.ray.direction;
  for (const Light* light : scene_->lights().infinite()) {
    add(w, *light, at, light->background(w.ray.direction), out);
  }
}

// Light drawn for the camera's point, weighted against meeting it with the first ray.
void Path::add_to_sensor(const Emission& start, Walk& w, PrimarySample& u, Splats& out) const {
  w.pdf = start.pdf_direction;
  w.last = sensor_receiver(start);
  const SensorDraw draw(*scene_, pick_, start, w.ray.time, light_numbers(u, 0));
  if (limits_.min_bounces > 0 || !draw.succeeded()) return;
  if (!limits_.paths.ends(draw.letter(), w.state)) return;
  const Passage way = draw.way();
  if (!(way.visibility > 0.f)) return;
  const float weight = power_weight(draw.pdf(), draw.met() * mean(way.transmittance));
  out.camera(weight * way.light() * draw.value(), {0, 1, 1});
}

// Next event estimation, weighted against meeting the light by chance.
void Path::add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const {
  if (w.bounces < limits_.min_bounces) return;
  const LightDraw draw(*scene_, pick_, s, light_numbers(u, w.bounces));
  if (!draw.succeeded()) return;
  if (!limits_.paths.ends(draw.letter(), limits_.paths.camera_step(w.state, false))) return;
  const Toward& t = draw.toward();
  const Rgb f = s.f_cos(t.wi, Transport::radiance);
  if (is_black(f)) return;
  const Rgb value = w.throughput * f * t.value / draw.pdf();
  if (is_black(value)) return;
  const Passage way = passage(*scene_, s.segment(t), s.medium_toward(t.wi));
  if (!(way.visibility > 0.f)) return;
  float weight = 1.f;
  if (draw.hittable()) {
    weight = power_weight(draw.pdf(), s.pdf(t.wi) * mean(way.transmittance));
  }
  const auto bounces = static_cast<uint32_t>(w.bounces);
  out.camera(weight * way.light() * value,
             {bounces, 1, static_cast<uint8_t>(std::min(w.bounces + 1, 255))});
}

// Chooses the next direction, or the point where the path leaves the surface it went beneath; false
// where the path ends.
bool Path::scatter(Walk& w, Surface& s, PrimarySample& u) const {
  const ScatterNumbers n = scatter_numbers(u, Stream::camera, w.bounces);
  const auto next = s.sample(n.lobe, n.direction, Transport::radiance);
  if (!next || is_black(next->weight)) return false;
  w.throughput *= next->weight;
  if (next->transmitted) w.eta_squared *= next->eta * next->eta;
  const float q = survival(w.bounces, max_component(w.throughput) * w.eta_squared);
  if (q < 1.f && !(n.roulette < q)) return false;
  w.throughput /= q;
  w.state = limits_.paths.camera_step(w.state, next->delta);
  if (next->beneath) [[unlikely]] {
    const Rgb factor = go_beneath(*scene_, s, *next->beneath, n, next->pdf, s);
    w.throughput *= factor;
    w.emerges = true;
    return !is_black(factor) && !limits_.paths.camera_dead(w.state);
  }
  w.pdf = next->delta || !next_event_ ? 0.f : next->pdf;
  w.last = light_receiver(*scene_, pick_, s);
  w.ray = s.spawn(next->wi);
  w.medium = s.medium_toward(next->wi);
  return !limits_.paths.camera_dead(w.state);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "path", pssmlt::Path, {"volpath", ""}, {"simplepath", ""},
              {"simplevolpath", ""}, {"randomwalk", ""})
