// No sample allocates: every integrator under every sampler, after its buffers have grown.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "app/defaults.h"
#include "core/plugin/registry.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/scene/parser.h"

namespace {
thread_local uint64_t allocations = 0;
}  // namespace

#if defined(__GNUC__) && !defined(__clang__)
// Both are replaced as a pair; gcc sees one of them inlined.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif
// The program's own operator new replaces the library's for everything it loads.
void* operator new(size_t size) {
  ++allocations;
  if (void* const p = std::malloc(size != 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }

namespace pssmlt {
namespace {

constexpr const char* scene_text = R"(
LookAt 0 1 -4  0 1 0  0 1 0
Camera "perspective" "float fov" 45 "float lensradius" 0.02 "float focaldistance" 4
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
WorldBegin
LightSource "point" "point3 from" [0 2.5 -1] "rgb I" [3 3 3]
LightSource "infinite" "rgb L" [0.2 0.2 0.3]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [8 8 8]
  Translate 1 2 0
  Shape "sphere" "float radius" 0.2
AttributeEnd
Material "diffuse"
Shape "disk" "float radius" 5
AttributeBegin
  Rotate -90 1 0 0
  Shape "disk" "float radius" 5
AttributeEnd
Material "dielectric"
AttributeBegin
  Translate -0.6 0.6 0
  Shape "sphere" "float radius" 0.6
AttributeEnd
Texture "holes" "float" "checkerboard" "float uscale" 8 "float vscale" 8
Material "conductor" "float roughness" 0.1
AttributeBegin
  Translate 0.8 0.5 0
  Shape "sphere" "float radius" 0.5 "texture alpha" "holes"
AttributeEnd
)";

class NowhereSink final : public SplatSink {
 public:
  void add(int, const Splats&, const PixelCredit&, double, int) override {}
};

// One thread's tools and a loop in place of a session.
class Loop {
 public:
  explicit Loop(const BuiltScene& built)
      : layer_(built.layers[0]),
        owner_(*built.raster_map),
        evaluator_(*layer_.integrator, log_),
        worker_{owner_, splats_, workspace_, evaluator_} {
    const SamplerContext context{*built.scene, *layer_.integrator, *built.raster_map, 1,
                                 [&](int count, const std::function<void(int, Worker&)>& body) {
                                   for (int i = 0; i < count; ++i) body(i, worker_);
                                 }};
    layer_.sampler->start(context);
  }
  // Allocations of a whole round.
  uint64_t run(int round) {
    const uint64_t before = allocations;
    for (int unit = 0; unit < layer_.sampler->units(round); ++unit) {
      layer_.sampler->run(round, unit, sink_, worker_);
    }
    return allocations - before;
  }
  const Layer& layer() const { return layer_; }

 private:
  const Layer& layer_;
  RejectionLog log_;
  PrimarySampleOwner owner_;
  Splats splats_;
  Workspace workspace_;
  Evaluator evaluator_;
  Worker worker_;
  NowhereSink sink_;
};

// A unit may set up its buffers, a chain may grow where it is stored; a sample may do neither.
TEST(Allocation, NoSampleAllocates) {
  const SceneDescription description = parse_string(scene_text, "allocation");
  for (const std::string& integrator : Registry::instance().names("integrator")) {
    for (const std::string& sampler : Registry::instance().names("sampler")) {
      SCOPED_TRACE(integrator + " under " + sampler);
      BuildOptions options;
      options.defaults = default_plugins();
      options.integrator = integrator;
      options.sampler = sampler;
      const BuiltScene built = build_scene(description, options);
      Loop loop(built);
      constexpr int warm_up = 6;
      for (int round = 0; round < warm_up; ++round) loop.run(round);
      const uint64_t counted = loop.run(warm_up);
      const Sampler& s = *loop.layer().sampler;
      const double a_sample = static_cast<double>(counted) / s.samples(warm_up);
      EXPECT_LT(a_sample, 0.05) << counted << " allocations in " << s.samples(warm_up)
                                << " samples of " << s.units(warm_up) << " units";
    }
  }
}

}  // namespace
}  // namespace pssmlt
