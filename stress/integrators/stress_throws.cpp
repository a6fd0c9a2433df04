// An integrator that throws: on a share of all samples, or when it is prepared. What it does not
// throw at has radiance 1. For `pssmlt stress` alone.
#include <stdexcept>

#include "core/integrator.h"
#include "core/path/path_expression.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class StressThrows final : public Integrator {
 public:
  static constexpr const char* summary = "throws on purpose";

  explicit StressThrows(Parameters& p)
      : limits_(p),
        probability_(p.number("probability", 1e-3f, "", "share of samples at which it throws")),
        prepare_throws_(p.flag("prepare", false, "throw before the render starts")) {}

  void prepare(const Scene&) override {
    if (prepare_throws_) throw std::runtime_error("stress_throws: thrown on purpose");
  }
  std::string sees() const override { return "L.*E"; }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }
  void sample(PrimarySample& u, Splats& out, Workspace&) const override {
    (void)u.raster();
    if (u.numbers(Stream::camera, 1).next() < probability_) {
      throw std::runtime_error("stress_throws: thrown on purpose");
    }
    out.camera(Rgb(1.f), {});
  }

 private:
  PathLimits limits_;
  float probability_;
  bool prepare_throws_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "stress_throws", pssmlt::StressThrows)
