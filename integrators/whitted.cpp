// Whitted 1980, An Improved Illumination Model for Shaded Display: perfect mirrors and glass are
// followed, one randomly chosen branch a vertex; the first surface that is not perfectly specular
// is lit directly by one light and ends the path. Fast previews; blind to all light that two rough
// surfaces exchange and to caustics.

#include "core/integrator.h"
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

  explicit Whitted(Parameters& p) : limits_(p) {}

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
    Rgb throughput{1.f};
    int bounces = 0;
    PathExpression::State state = 0;
  };
  void add(const Walk& w, LightLetter letter, int s, const Rgb& light, Splats& out) const;
  void add_background(const Walk& w, Splats& out) const;
  void add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const;
  bool follow(Walk& w, const Surface& s, PrimarySample& u) const;

  PathLimits limits_;
  const Scene* scene_ = nullptr;
};

void Whitted::sample(PrimarySample& u, Splats& out, Workspace&) const {
  const SceneFeatures& features = scene_->features();
  const dvec2 raster = u.raster();
  const auto start = scene_->camera().emit(lens_numbers(u), raster);
  if (!start) return;
  Walk w;
  w.throughput = start->weight();
  w.ray = {offset_origin(start->from.position, start->error, start->from.normal, start->direction),
           start->direction, infinity};
  w.state = limits_.paths.from_camera();
  Surface s;
  for (;;) {
    if (!scene_->intersect(w.ray, alpha_number(u, Stream::camera, w.bounces, features), s.hit)) {
      return add_background(w, out);
    }
    if (const Light* light = s.hit.primitive->light) {
      add(w, light_letter(light->traits()), 0, scene_->emitted(s.hit, -w.ray.direction), out);
    }
    if (w.bounces == limits_.max_bounces) return;
    ++w.bounces;
    const MaterialNumbers m = material_numbers(u, Stream::camera, w.bounces, features);
    if (!s.shade(*scene_, -w.ray.direction, m)) return;
    if (s.connectible()) add_direct(w, s, u, out);
    if (!follow(w, s, u)) return;
  }
}

// Light [W/(m^2 sr)] that arrives along the path; s = 1: from a point drawn on the light.
void Whitted::add(const Walk& w, LightLetter letter, int s, const Rgb& light, Splats& out) const {
  const auto state = s == 1 ? limits_.paths.camera_step(w.state, false) : w.state;
  if (w.bounces < limits_.min_bounces || !limits_.paths.ends(letter, state)) return;
  out.camera(w.throughput * light, {static_cast<uint16_t>(w.bounces), static_cast<uint8_t>(s),
                                    static_cast<uint8_t>(std::min(w.bounces + 2 - s, 255))});
}

void Whitted::add_background(const Walk& w, Splats& out) const {
  for (const Light* light : scene_->lights().infinite()) {
    add(w, light_letter(light->traits()), 0, light->background(w.ray.direction), out);
  }
}

void Whitted::add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const {
  const LightDraw draw(*scene_, s.hit.position, light_numbers(u, w.bounces));
  if (!draw.succeeded()) return;
  const Rgb f = s.f_cos(draw.toward().wi, Transport::radiance);
  const Rgb value = f * draw.toward().value / draw.pdf();
  if (is_black(value)) return;
  add(w, draw.letter(), 1, scene_->visibility(s.segment(draw.toward())) * value, out);
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
  return true;
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "whitted", pssmlt::Whitted)
