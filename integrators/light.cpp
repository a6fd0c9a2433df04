// Light tracing (Arvo 1986; Dutre et al. 1993): paths start at the lights and every vertex that can
// be joined, that of a finite light included, is connected to the lens. Good for caustics and for
// strong light on the surfaces in view; noisy for small parts of large scenes; blind to everything
// seen through perfectly specular surfaces and to environments seen directly.

#include "core/integrator.h"
#include "core/path/numbers.h"
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
    tracer_ = std::make_unique<SubpathTracer>(scene, limits_, Mis(Mis::Heuristic::balance));
  }
  std::string sees() const override {
    return strategy::any_of({strategy::lens, strategy::light_to_lens});
  }
  bool splats_light() const override { return true; }
  const PathLimits& limits() const override { return limits_; }

  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override {
    Subpath& path = workspace.scratch<Subpath>();
    path.reserve(std::min(limits_.max_bounces, 200));
    if (scene_->lights().empty()) return;
    tracer_->from_light(u, path);
    if (!path.started) return;
    add_light(path, u, out);
    for (int k = 1; k <= path.size(); ++k) {
      if (path[k].connectible) add_vertex(path[k], k, u, out);
    }
  }

 private:
  void add_light(const Subpath& path, PrimarySample& u, Splats& out) const;
  void add_vertex(const PathVertex& v, int k, PrimarySample& u, Splats& out) const;
  bool wants(int bounces, PathExpression::State state) const {
    return limits_.in_range(bounces) && limits_.paths.joins(state, limits_.paths.from_camera());
  }

  PathLimits limits_;
  const Scene* scene_ = nullptr;
  std::unique_ptr<const SubpathTracer> tracer_;
};

// The light itself as the lens sees it: the emitted point, toward a point of the lens.
void LightTracer::add_light(const Subpath& path, PrimarySample& u, Splats& out) const {
  const EndpointTraits& traits = path.traits;
  if (traits.infinite || traits.delta_position || traits.delta_direction) return;
  if (!wants(0, limits_.paths.from_light(LightLetter::area))) return;
  const EndpointPoint& at = path.start.from;
  const auto lens = scene_->camera().toward(at.position, lens_connection_numbers(u, 0));
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const EmissionValue e = path.emitted(lens->wi);
  const Rgb value = e.value * lens->value * e.cosine /
                    (path.probability * path.start.pdf_position * lens->pdf_toward);
  if (is_black(value)) return;
  const Ray ray = Scene::segment(at.position, path.start.error, at.normal, lens->at.position,
                                 lens->error, lens->at.normal);
  out.light(lens->raster, scene_->visibility(ray) * value, {0, 1, 1});
}

void LightTracer::add_vertex(const PathVertex& v, int k, PrimarySample& u, Splats& out) const {
  if (!wants(k, v.joined_state)) return;
  const Surface& s = v.surface;
  const auto lens = scene_->camera().toward(s.hit.position, lens_connection_numbers(u, k));
  if (!lens || !(lens->pdf_toward > 0.f)) return;
  const Rgb value =
      v.throughput * s.f_cos(lens->wi, Transport::importance) * lens->value / lens->pdf_toward;
  if (is_black(value)) return;
  out.light(lens->raster, scene_->visibility(s.segment(*lens)) * value,
            {static_cast<uint16_t>(k), static_cast<uint8_t>(std::min(k + 1, 255)), 1});
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "light", pssmlt::LightTracer, {"lightpath", ""})
