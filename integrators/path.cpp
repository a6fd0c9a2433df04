// Path tracing (Kajiya 1986) with next event estimation, both ways of finding a light combined by
// multiple importance sampling (Veach 1997, chapter 9, power heuristic), and Russian roulette from
// the third vertex on. Good where most light comes from lamps that the surfaces see; noisy for
// caustics and for light through small openings; blind to point, spot and distant lights seen
// through specular surfaces only (and to nothing else that bdpt sees).

#include "core/base/log.h"
#include "core/integrator.h"
#include "core/path/light_draw.h"
#include "core/path/mis.h"
#include "core/path/strategies.h"
#include "core/path/surface.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr std::string_view light_samplers[] = {"bvh", "power", "uniform"};

class Path final : public Integrator {
 public:
  static constexpr const char* summary =
      "path tracing with next event estimation and multiple importance sampling (Kajiya 1986)";

  explicit Path(Parameters& p) : limits_(p) {
    const std::string lights =
        p.choice("lightsampler", "power", light_samplers,
                 "how lights are chosen; only power is built, the others are read as power");
    const bool regularize =
        p.flag("regularize", false, "roughen surfaces after a rough bounce; not supported yet");
    if (p.describing()) return;
    if (lights != "power") log_info("lightsampler \"" + lights + "\": lights are chosen by power");
    if (regularize) p.fail("regularize", "regularize is not supported yet");
  }

  void prepare(const Scene& scene) override {
    scene_ = &scene;
    hittable_ = scene.features().area_lights || scene.features().infinite_lights;
    next_event_ = scene.features().connectible && !scene.lights().empty();
  }
  std::string sees() const override {
    return strategy::any_of({strategy::hit_light, strategy::next_event});
  }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  // Where the path stands: the ray to trace and what came before it.
  struct Walk {
    Ray ray;
    vec3 from{0.f};  // last vertex
    Rgb throughput{1.f};
    float pdf = 0.f;          // of the ray's direction [1/sr]; 0: no light could have been drawn
    float eta_squared = 1.f;  // product of squared index ratios, which roulette looks through
    int bounces = 0;
    PathExpression::State state = 0;
  };
  void add_emission(const Walk& w, const Hit& hit, Splats& out) const;
  void add_background(const Walk& w, Splats& out) const;
  void add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const;
  bool scatter(Walk& w, const Surface& s, PrimarySample& u) const;
  void add(const Walk& w, const Light& light, const EndpointPoint& at, const Rgb& value,
           Splats& out) const;

  PathLimits limits_;
  const Scene* scene_ = nullptr;
  bool hittable_ = false;    // there are lights that rays can meet
  bool next_event_ = false;  // there are lights to draw and surfaces that can be lit by the draw
};

void Path::sample(PrimarySample& u, Splats& out, Workspace&) const {
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
    if (s.hit.primitive->light) add_emission(w, s.hit, out);
    if (w.bounces == limits_.max_bounces) return;
    ++w.bounces;
    const MaterialNumbers m = material_numbers(u, Stream::camera, w.bounces, features);
    if (!s.shade(*scene_, -w.ray.direction, m)) return;
    if (next_event_ && s.connectible()) add_direct(w, s, u, out);
    if (w.bounces == limits_.max_bounces && !hittable_) return;
    if (!scatter(w, s, u)) return;
  }
}

// Light that the path met, weighted against having drawn the same point of the light.
void Path::add(const Walk& w, const Light& light, const EndpointPoint& at, const Rgb& value,
               Splats& out) const {
  if (is_black(value) || w.bounces < limits_.min_bounces) return;
  if (!limits_.paths.ends(light_letter(light.traits()), w.state)) return;
  float weight = 1.f;
  if (w.pdf > 0.f) {
    const float drawn = scene_->lights().probability(&light) * light.pdf_toward(w.from, at);
    weight = power_weight(w.pdf, drawn);
  }
  const auto bounces = static_cast<uint16_t>(w.bounces);
  out.camera(weight * w.throughput * value,
             {bounces, 0, static_cast<uint8_t>(std::min(w.bounces + 2, 255))});
}

void Path::add_emission(const Walk& w, const Hit& hit, Splats& out) const {
  add(w, *hit.primitive->light, {hit.position, hit.ng, hit.uv, hit.element},
      scene_->emitted(hit, -w.ray.direction), out);
}

void Path::add_background(const Walk& w, Splats& out) const {
  EndpointPoint at;
  at.normal = -w.ray.direction;
  for (const Light* light : scene_->lights().infinite()) {
    add(w, *light, at, light->background(w.ray.direction), out);
  }
}

// Next event estimation, weighted against meeting the light by chance.
void Path::add_direct(const Walk& w, const Surface& s, PrimarySample& u, Splats& out) const {
  if (w.bounces < limits_.min_bounces) return;
  const LightDraw draw(*scene_, s.hit.position, light_numbers(u, w.bounces));
  if (!draw.succeeded()) return;
  if (!limits_.paths.ends(draw.letter(), limits_.paths.camera_step(w.state, false))) return;
  const Toward& t = draw.toward();
  const Rgb f = s.f_cos(t.wi, Transport::radiance);
  if (is_black(f)) return;
  const float weight = draw.delta() ? 1.f : power_weight(draw.pdf(), s.pdf(t.wi));
  const Rgb value = w.throughput * f * t.value * (weight / draw.pdf());
  if (is_black(value)) return;
  const float visible = scene_->visibility(s.segment(t));
  const auto bounces = static_cast<uint16_t>(w.bounces);
  out.camera(visible * value, {bounces, 1, static_cast<uint8_t>(std::min(w.bounces + 1, 255))});
}

// Chooses the next direction; false where the path ends.
bool Path::scatter(Walk& w, const Surface& s, PrimarySample& u) const {
  const ScatterNumbers n = scatter_numbers(u, Stream::camera, w.bounces);
  const auto next = s.sample(n.lobe, n.direction, Transport::radiance);
  if (!next || is_black(next->weight)) return false;
  w.throughput *= next->weight;
  if (next->transmitted) w.eta_squared *= next->eta * next->eta;
  const float q = survival(w.bounces, max_component(w.throughput) * w.eta_squared);
  if (q < 1.f && !(n.roulette < q)) return false;
  w.throughput /= q;
  w.state = limits_.paths.camera_step(w.state, next->delta);
  w.pdf = next->delta || !next_event_ ? 0.f : next->pdf;
  w.from = s.hit.position;
  w.ray = s.spawn(next->wi);
  return !limits_.paths.camera_dead(w.state);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "path", pssmlt::Path, {"volpath", ""}, {"simplepath", ""},
              {"simplevolpath", ""})
