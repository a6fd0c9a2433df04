// Independent uniform numbers: the plainest estimate, whose error every other sampler is measured
// against. Counter-based (Salmon et al. 2011), so that any sample can be replayed alone. Good at
// nothing, wrong at nothing; error falls like 1/sqrt(samples).
#include "core/plugin/plugin.h"
#include "core/sampling/memoryless.h"

namespace pssmlt {
namespace {

class Independent final : public MemorylessSampler {
 public:
  static constexpr const char* summary = "Independent uniform random numbers.";
  explicit Independent(Parameters& p) : Independent(read(p)) {}

 private:
  struct Settings {
    int samples = 16;
    uint32_t seed = 0;
  };
  explicit Independent(const Settings& s) : MemorylessSampler("independent", s.samples, s.seed) {}

  static Settings read(Parameters& p) {
    Settings s;
    s.samples = p.integer("pixelsamples", 16, "samples", "default number of samples per pixel");
    s.seed =
        static_cast<uint32_t>(p.integer("seed", 0, "", "another seed gives another noise pattern"));
    if (s.samples < 1) p.fail("pixelsamples", "\"pixelsamples\" must be at least 1");
    return s;
  }

  void fill(const SampleId& id, Stream stream, uint32_t index, NumberBlock& block) const override {
    const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
    const auto use = static_cast<uint32_t>(RandomUse::sample);
    const auto sweep_high = static_cast<uint32_t>(id.sweep >> 32);
    block =
        philox(seed(), {static_cast<uint32_t>(id.sweep), id.pixel, what, use | sweep_high << 8});
  }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "independent", pssmlt::Independent, {"random", ""})
