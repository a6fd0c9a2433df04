// Path tracing without next event estimation (Kajiya 1986): a path is continued by sampling the
// scattering functions alone and carries light when it happens to run into a lamp or the sky.
// Parameters: "mindepth", "maxdepth", "paths" as of every integrator, and "roulettedepth". Good
// where lamps are large; blind to point, spot and distant lights, which no path can meet.
#include <algorithm>

#include "core/integrator.h"
#include "core/path/flight.h"
#include "core/path/path_expression.h"
#include "core/path/strategies.h"
#include "core/path/surface.h"
#include "core/plugin/plugin.h"

namespace {
using namespace pssmlt;

class NaivePath final : public Integrator {
 public:
  static constexpr const char* summary = "path tracing that meets lights by chance alone";

  explicit NaivePath(Parameters& p)
      : limits_(p),
        roulette_depth_(p.integer("roulettedepth", 3, "", "bounces that roulette never ends")) {}

  void prepare(const Scene& scene) override { scene_ = &scene; }
  void sample(PrimarySample& u, Splats& out, Workspace&) const override;
  std::string sees() const override { return strategy::hit_light; }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }

 private:
  // A path that ends on a light of this kind after `bounces` scattering events, if it is asked for.
  void add(Splats& out, const Rgb& value, LightLetter light, PathExpression::State state,
           int bounces) const {
    if (!limits_.in_range(bounces) || !limits_.paths.ends(light, state)) return;
    out.camera(value, {.bounces = static_cast<uint32_t>(bounces),
                       .t = static_cast<uint8_t>(std::min(bounces + 2, 255))});
  }

  PathLimits limits_;
  int roulette_depth_;
  const Scene* scene_ = nullptr;
};

void NaivePath::sample(PrimarySample& u, Splats& out, Workspace&) const {
  const SceneFeatures& features = scene_->features();
  const dvec2 raster = u.raster();
  const float time = time_number(u, *scene_);
  const auto start = scene_->camera_emit(lens_numbers(u), raster, time);
  if (!start) return;

  Ray ray = leaving(*start, time);
  const Medium* medium = scene_->camera_medium();  // where the ray starts
  Rgb throughput = start->weight();
  float eta2 = 1.f;  // what refraction did to the throughput and will undo: not for roulette
  PathExpression::State state = limits_.paths.from_camera();
  for (int bounces = 0; bounces <= limits_.max_bounces; ++bounces) {
    Surface surface;
    Flight flight;
    const EdgeNumbers edge = edge_numbers(u, Stream::camera, bounces, features);
    const Arrival arrival = fly(*scene_, ray, medium, edge, surface, flight);
    if (arrival == Arrival::absorbed) return;
    throughput *= flight.weight();
    if (arrival == Arrival::nothing) {
      const Rgb sky = scene_->background(ray.direction);
      return add(out, throughput * sky, LightLetter::infinite, state, bounces);
    }
    if (arrival == Arrival::surface) {
      const Rgb lamp = scene_->emitted(surface.hit, -ray.direction);
      add(out, throughput * lamp, LightLetter::area, state, bounces);
    } else {
      add(out, throughput * surface.point().emission, LightLetter::medium, state, bounces);
    }

    const int vertex = bounces + 1;  // of the camera stream; the camera itself is vertex 0
    const auto material = material_numbers(u, Stream::camera, vertex, features);
    if (!surface.shade(*scene_, -ray.direction, material)) return;
    const ScatterNumbers numbers = scatter_numbers(u, Stream::camera, vertex);
    const auto next = surface.sample(numbers.lobe, numbers.direction, Transport::radiance);
    if (!next) return;

    throughput *= next->weight;
    if (next->transmitted) eta2 *= sqr(next->eta);
    if (bounces >= roulette_depth_) {
      const float survival = std::min(1.f, max_component(throughput) * eta2);
      if (numbers.roulette >= survival) return;
      throughput /= survival;
    }
    state = limits_.paths.camera_step(state, next->delta);
    ray = surface.spawn(next->wi);
    medium = surface.medium_toward(next->wi);
  }
}

}  // namespace

PSSMLT_PLUGIN(Integrator, "naive_path", NaivePath)
