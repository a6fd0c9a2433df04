// What a ray costs outside Embree: samples of an integrator are run with two threads, their rays
// recorded, and the same rays replayed through bare Embree. Prints rays per second of both, their
// ratio, and the time per ray that is not Embree's.
//   ray_cost SCENE [integrator ...]
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "app/defaults.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/scene/accel.h"
#include "core/scene/parser.h"
#include "core/scene/path_log.h"

namespace {
using namespace pssmlt;
using Clock = std::chrono::steady_clock;

class UniformSource final : public NumberSource {
 public:
  explicit UniformSource(uint32_t thread) : thread_(thread) {}
  void next() { ++sample_; }
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    block = philox(7, {sample_, thread_, index, static_cast<uint32_t>(stream)});
  }

 private:
  uint32_t thread_, sample_ = 0;
};

// Runs samples until `seconds` have passed or `limit` samples are done; returns their number.
int run_samples(const BuiltScene& built, uint32_t thread, int limit) {
  const Integrator& integrator = *built.layers[0].integrator;
  PrimarySampleOwner owner(*built.raster_map);
  UniformSource source(thread);
  Splats splats;
  Workspace workspace;
  for (int i = 0; i < limit; ++i) {
    source.next();
    owner.begin(source);
    splats.clear();
    integrator.sample(owner.sample(), splats, workspace);
  }
  return limit;
}

double in_two_threads(const std::function<void(uint32_t)>& body) {
  const auto start = Clock::now();
  { const std::jthread first(body, 0u), second(body, 1u); }
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void replay(const Accel& accel, const std::vector<RecordedRay>& rays) {
  RawHit hit;
  for (const RecordedRay& r : rays) {
    if (r.shadow) {
      accel.occluded(r.ray);
    } else {
      accel.intersect(r.ray, hit);
    }
  }
}

void measure(const std::string& scene, const std::string& integrator) {
  BuildOptions options;
  options.defaults = default_plugins();
  options.integrator = integrator;
  options.sampler = "independent";
  const BuiltScene built = build_scene(parse_file(scene, nullptr), options);
  std::vector<RecordedRay> rays[2];
  constexpr int samples = 60000;
  in_two_threads([&](uint32_t t) {
    record_rays(&rays[t]);
    run_samples(built, t, samples);
    record_rays(nullptr);
  });
  const double count = static_cast<double>(rays[0].size() + rays[1].size());
  double full = 1e30, bare = 1e30;
  for (int repeat = 0; repeat < 5; ++repeat) {
    full = std::min(full, in_two_threads([&](uint32_t t) { run_samples(built, t, samples); }));
    bare =
        std::min(bare, in_two_threads([&](uint32_t t) { replay(built.scene->accel(), rays[t]); }));
  }
  fmt::print(
      "{:10} {:8.0f} K samples/s  {:6.2f} rays/sample  {:6.2f} Mray/s  bare Embree {:6.2f} "
      "Mray/s  ratio {:.2f}  outside Embree {:.0f} ns/ray\n",
      integrator, 2e-3 * samples / full, count / (2.0 * samples), count / full * 1e-6,
      count / bare * 1e-6, bare / full, (full - bare) / count * 2.0 * 1e9);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return fmt::print(stderr, "usage: ray_cost SCENE [integrator ...]\n"), 2;
  std::vector<std::string> integrators(argv + 2, argv + argc);
  if (integrators.empty()) integrators = {"path", "bdpt"};
  try {
    for (const std::string& integrator : integrators) measure(argv[1], integrator);
  } catch (const std::exception& error) {
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
