// Whitted 1980, An Improved Illumination Model for Shaded Display: perfect mirrors and glass are
// followed, one randomly chosen branch a vertex; the first surface that is not perfectly specular,
// or the first point of a medium that scatters, is lit directly by one light and ends the path.
// Fast previews; blind to all light that two rough surfaces exchange, to what media scatter more
// than once and to caustics.

#include "core/integrator.h"
#include "core/path/dispersion.h"
#include "core/path/flight.h"
#include "core/path/light_draw.h"
#include "core/path/strategies.h"
#include "core/path/surface.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Whitted final : public Integrator {
 public:
  static constexpr const char* summary =
      "direct light and perfectly specular chains (Whitted 1980)";

  explicit Whitted(Parameters& p) : limits_(p), pick_(read_light_pick(p)) {}

  void prepare(const Scene& scene) override { scene_ = &scene; }
  std::string sees() const override {
    return strategy::any_of({strategy::specular_hit, strategy::specular_next_event});
  }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  struct Walk {
    Ray ray;
    const Medium* medium = nullptr;  // where the ray starts
    Rgb throughput{1.f};
    int bounces = 0;
    bool dispersed = false;  // the path has a wavelength
    PathExpression::State state = 0;
  };
  void add(const Walk& w, LightLetter letter, int s, const Rgb& light, Splats& out) const;
  void add_background(const Walk& w, Splats& out) const;
  void add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const;
  bool follow(Walk& w, const Surface& s, PrimarySample& u) const;

  PathLimits limits_;
  LightPick pick_;
  const Scene* scene_ = nullptr;
};

void Whitted::sample(PrimarySample& u, Splats& out, Workspace&) const {
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
  Surface s;
  for (;;) {
    Flight flight;
    const EdgeNumbers edge = edge_numbers(u, Stream::camera, w.bounces, features);
    const Arrival arrival = fly(*scene_, w.ray, w.medium, edge, s, flight);
    if (arrival == Arrival::absorbed) return;
    w.throughput *= flight.weight();
    if (arrival == Arrival::nothing) return add_background(w, out);
    if (arrival == Arrival::medium) {
      add(w, LightLetter::medium, 0, s.point().emission, out);
    } else if (const Light* light = s.hit.primitive->light) {
      add(w, light_letter(light->traits()), 0, scene_->emitted(s.hit, -w.ray.direction), out);
    }
    if (w.bounces == limits_.max_bounces) return;
    ++w.bounces;
    const MaterialNumbers m = material_numbers(u, Stream::camera, w.bounces, features);
    if (!s.shade(*scene_, -w.ray.direction, m)) return;
    if (!w.dispersed && s.disperses(*scene_)) {
      w.dispersed = true;
      w.throughput *= path_wavelength(u).colour;
    }
    if (s.connectible()) add_direct(w, s, u, out);
    if (!follow(w, s, u)) return;
  }
}

// Light [W/(m^2 sr)] that arrives along the path; s = 1: from a point drawn on the light.
void Whitted::add(const Walk& w, LightLetter letter, int s, const Rgb& light, Splats& out) const {
  const auto state = s == 1 ? limits_.paths.camera_step(w.state, false) : w.state;
  if (w.bounces < limits_.min_bounces || !limits_.paths.ends(letter, state)) return;
  out.camera(w.throughput * light, {static_cast<uint32_t>(w.bounces), static_cast<uint8_t>(s),
                                    static_cast<uint8_t>(std::min(w.bounces + 2 - s, 255))});
}

void Whitted::add_background(const Walk& w, Splats& out) const {
  for (const Light* light : scene_->lights().infinite()) {
    add(w, light_letter(light->traits()), 0, light->background(w.ray.direction), out);
  }
}

void Whitted::add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const {
  const LightDraw draw(*scene_, pick_, s, light_numbers(u, w.bounces));
  if (!draw.succeeded()) return;
  const Rgb f = s.f_cos(draw.toward().wi, Transport::radiance);
  const Rgb value = f * draw.toward().value / draw.pdf();
  if (is_black(value)) return;
  const vec3& wi = draw.toward().wi;
  const Passage way = passage(*scene_, s.segment(draw.toward()), s.medium_toward(wi));
  add(w, draw.letter(), 1, way.light() * value, out);
}

// Goes on along a perfectly specular direction; false where there is none.
bool Whitted::follow(Walk& w, const Surface& s, PrimarySample& u) const {
  const ScatterNumbers n = scatter_numbers(u, Stream::camera, w.bounces);
  const auto next = s.sample(n.lobe, n.direction, Transport::radiance);
  if (!next || !next->delta || is_black(next->weight)) return false;
  w.throughput *= next->weight;
  const float q = survival(w.bounces, max_component(w.throughput));
  if (q < 1.f && !(n.roulette < q)) return false;
  w.throughput /= q;
  w.state = limits_.paths.camera_step(w.state, true);
  w.ray = s.spawn(next->wi);
  w.medium = s.medium_toward(next->wi);
  return true;
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "whitted", pssmlt::Whitted)
