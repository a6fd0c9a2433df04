// Owen-scrambled Sobol' points (Burley 2020): numbers of a pixel fill their dimensions evenly, four
// dimensions together, for any number of samples and dimensions; the error of smooth integrands
// falls faster than 1/sqrt(samples). The light stream is one sequence over a sixteenth of the
// pixels, so that light subpaths cover the lights evenly. The default sampler.
#include <array>

#include "core/base/log.h"
#include "core/plugin/plugin.h"
#include "core/sampling/sobol_sweeps.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> randomizations = {"none", "permutedigits", "fastowen",
                                                            "owen"};

class Sobol final : public SobolSweeps {
 public:
  static constexpr const char* summary = "Owen-scrambled Sobol' sequence of any dimension.";
  explicit Sobol(Parameters& p) : Sobol(read(p)) {}

 private:
  struct Settings {
    int samples = 16;
    uint32_t seed = 0;
  };
  explicit Sobol(const Settings& s) : SobolSweeps("sobol", s.samples, s.seed) {}

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
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "sobol", pssmlt::Sobol, {"halton", ""}, {"zsobol", ""}, {"paddedsobol", ""},
              {"pmj02bn", ""}, {"02sequence", ""})
