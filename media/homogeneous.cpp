// A medium that is the same everywhere: fog, milk, tinted glass. Source: pbrt-v4's homogeneous
// medium for the parameters. Without a surface that bounds it, it fills the space, and no
// environment light gets through.
#include "core/media/homogeneous_medium.h"
#include "core/media/medium_parameters.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Homogeneous final : public HomogeneousMedium {
 public:
  static constexpr const char* summary = "the same everywhere";

  explicit Homogeneous(Parameters& p)
      : Homogeneous(
            ScatteringParameters(p, true, Rgb(.0011f, .0024f, .014f), Rgb(2.55f, 3.21f, 3.77f)),
            read_emitted_radiance(p)) {}

 private:
  Homogeneous(const ScatteringParameters& s, const Rgb& radiance)
      : HomogeneousMedium({s.extinction(), s.scattering, s.absorption * radiance}, s.g) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Medium, "homogeneous", pssmlt::Homogeneous)
