// Owen-scrambled Sobol' points (Burley 2020): numbers of a pixel fill their dimensions evenly, four
// dimensions together, for any number of samples and dimensions; the error of smooth integrands
// falls faster than 1/sqrt(samples). The light stream is one sequence over a sixteenth of the
// pixels, so that light subpaths cover the lights evenly. The default sampler.
//
// Even and odd sweeps have scrambles of their own, so that the two half images are independent and
// their difference tells the error. Many scrambles would give up most of the gain: at 64 samples 32
// of them cost a factor 6 in variance on a quarter disk and 100 on a smooth function, two 1.5
// and 4.
#include <array>

#include "core/base/log.h"
#include "core/plugin/plugin.h"
#include "core/sampling/memoryless.h"
#include "core/sampling/sobol.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> randomizations = {"none", "permutedigits", "fastowen",
                                                            "owen"};

class Sobol final : public MemorylessSampler {
 public:
  static constexpr const char* summary = "Owen-scrambled Sobol' sequence of any dimension.";
  explicit Sobol(Parameters& p) : Sobol(read(p)) {}

 private:
  struct Settings {
    int samples = 16;
    uint32_t seed = 0;
  };
  explicit Sobol(const Settings& s) : MemorylessSampler("sobol", s.samples, s.seed) {}

  static Settings read(Parameters& p) {
    Settings s;
    s.samples = p.integer("pixelsamples", 16, "samples", "default number of samples per pixel");
    s.seed =
        static_cast<uint32_t>(p.integer("seed", 0, "", "another seed gives another noise pattern"));
    const std::string randomization =
        p.choice("randomization", "fastowen", randomizations,
                 "accepted for pbrt's scenes; points are always Owen-scrambled by hashing");
    if (s.samples < 1) p.fail("pixelsamples", "\"pixelsamples\" must be at least 1");
    if (randomization != "fastowen" && !p.describing()) {
      log_info(p.owner() + ": \"randomization\" \"" + randomization +
               "\" is replaced by hashed Owen scrambling");
    }
    return s;
  }

  void fill(const SampleId& id, Stream stream, uint32_t index, NumberBlock& block) const override {
    const uint64_t name = (static_cast<uint64_t>(stream) * 2 + id.half()) | id.turn << 3;
    if (stream == Stream::light) {
      const uint64_t sequence = uint64_t{id.part} << 8 | name;
      block =
          sobol_block(seed() + mix_bits(sequence + 1), id.nth * id.part_pixels + id.place, index);
      return;
    }
    const uint64_t sequence = (uint64_t{id.pixel} << 8 | name) + 1;
    block = sobol_block(seed() + mix_bits(sequence * 0x9E3779B97F4A7C15ull), id.nth, index);
  }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "sobol", pssmlt::Sobol, {"halton", ""}, {"zsobol", ""}, {"paddedsobol", ""},
              {"pmj02bn", ""}, {"02sequence", ""})
