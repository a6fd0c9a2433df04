// Light tracing (Arvo 1986; Dutre et al. 1993): paths start at the lights and every vertex that can
// be joined, that of a finite light included, is connected to the lens. Good for caustics and for
// strong light on the surfaces in view; noisy for small parts of large scenes; blind to everything
// seen through perfectly specular surfaces and to environments seen directly. A camera that is a
// bare surface gets the light of lamps without a size by a draw of its own.

#include "core/integrator.h"
#include "core/path/dispersion.h"
#include "core/path/sensor_draw.h"
#include "core/path/strategies.h"
#include "core/path/subpath.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class LightTracer final : public Integrator {
 public:
  static constexpr const char* summary =
      "light tracing: paths from the lights, connected to the lens (Arvo 1986)";

  explicit LightTracer(Parameters& p) : limits_(p) {}

  void prepare(const Scene& scene) override {
    scene_ = &scene;
    sensor_ = scene.camera().bare();
    tracer_ = std::make_unique<SubpathTracer>(scene, limits_, Mis(Mis::Heuristic::balance));
  }
  std::string sees() const override {
    if (sensor_)
      return strategy::any_of(
          {strategy::lens, strategy::light_to_lens, strategy::sensor_draw_delta});
    return strategy::any_of({strategy::lens, strategy::light_to_lens});
  }
  bool splats_light() const override { return true; }
  const PathLimits& limits() const override { return limits_; }

  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override {
    Subpath& path = workspace.scratch<Subpath>();
    path.reserve(std::min(limits_.max_bounces, 200));
    if (scene_->lights().empty()) return;
    if (sensor_) add_delta_light(u, out);
    tracer_->from_light(u, path);
    if (!path.started) return;
    add_light(path, u, out);
    for (int k = 1; k <= path.size(); ++k) {
      if (path[k].connectible) add_vertex(path[k], k, u, out);
    }
  }

 private:
  void add_light(const Subpath& path, PrimarySample& u, Splats& out) const;
  void add_delta_light(PrimarySample& u, Splats& out) const;
  void add_vertex(const PathVertex& v, int k, PrimarySample& u, Splats& out) const;
  bool wants(int bounces, PathExpression::State state) const {
    return limits_.in_range(bounces) && limits_.paths.joins(state, limits_.paths.from_camera());
  }

  PathLimits limits_;
  const Scene* scene_ = nullptr;
  bool sensor_ = false;  // the camera is a bare surface
  std::unique_ptr<const SubpathTracer> tracer_;
};

// The light itself as the lens sees it: the emitted point, toward a point of the lens.
void LightTracer::add_light(const Subpath& path, PrimarySample& u, Splats& out) const {
  const EndpointTraits& traits = path.traits;
  if (traits.infinite || !traits.hittable()) return;
  if (!wants(0, limits_.paths.from_light(LightLetter::area))) return;
  const EndpointPoint& at = path.start.from;
  const auto lens = scene_->camera_toward(at.position, lens_connection_numbers(u, 0), path.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const EmissionValue e = path.emitted(lens->wi);
  const Rgb value = e.value * lens->value * e.cosine /
                    (path.probability * path.start.pdf_position * lens->pdf_toward);
  if (is_black(value)) return;
  const Ray ray = Scene::segment(at.position, path.start.error, at.normal, lens->at.position,
                                 lens->error, lens->at.normal, path.time);
  const Medium* const medium = scene_->light_medium(*path.light, at, lens->wi);
  out.light(lens->raster, passage(*scene_, ray, medium).light() * value, {0, 1, 1});
}

// A camera that is a bare surface sees lights without a size, too. Those at infinity have no point
// that could be joined with the camera: the camera's point is drawn first, then the light.
void LightTracer::add_delta_light(PrimarySample& u, Splats& out) const {
  const float time = time_number(u, *scene_);
  const vec2 lens = lens_numbers(u);
  const auto start = scene_->camera_emit(lens, u.raster(), time);
  if (!start) return;
  const SensorDraw draw(*scene_, LightPick::power, *start, time, light_numbers(u, 0));
  if (!draw.succeeded() || draw.letter() != LightLetter::delta) return;
  if (!wants(0, limits_.paths.from_light(LightLetter::delta))) return;
  out.camera(draw.way().light() * draw.value(), {0, 1, 1});
}

void LightTracer::add_vertex(const PathVertex& v, int k, PrimarySample& u, Splats& out) const {
  if (!wants(k, v.joined_state)) return;
  const Surface& s = v.surface;
  const auto lens = scene_->camera_toward(s.hit.position, lens_connection_numbers(u, k), s.time);
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  Rgb value =
      v.throughput * s.f_cos(lens->wi, Transport::importance) * lens->value / lens->pdf_toward;
  if (is_black(value)) return;
  if (v.dispersed) value *= path_wavelength(u).colour;
  const Passage way = passage(*scene_, s.segment(*lens), s.medium_toward(lens->wi));
  out.light(lens->raster, way.light() * value,
            {static_cast<uint32_t>(k), static_cast<uint8_t>(std::min(k + 1, 255)), 1});
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "light", pssmlt::LightTracer, {"lightpath", ""})
