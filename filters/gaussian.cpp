// A Gaussian lowered so that it reaches zero at the radius: smooth, never negative, slightly
// blurry.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 8.8.3.
#include "core/filter.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Gaussian final : public Filter {
 public:
  static constexpr const char* summary = "Gaussian cut and lowered to zero at its radius";

  explicit Gaussian(Parameters& p)
      : radius_(p.number("xradius", 1.5f, "pixels", "Half width of the support in x."),
                p.number("yradius", 1.5f, "pixels", "Half width of the support in y.")),
        sigma_(p.number("sigma", 0.5f, "pixels", "Standard deviation.")),
        edge_(gauss(radius_.x), gauss(radius_.y)) {
    if (!(radius_.x > 0.f)) p.fail("xradius", "\"xradius\" must be positive");
    if (!(radius_.y > 0.f)) p.fail("yradius", "\"yradius\" must be positive");
    if (!(sigma_ > 0.f)) p.fail("sigma", "\"sigma\" must be positive");
    if (!p.describing() && !(evaluate(vec2(0.f)) > 0.f))
      p.fail("sigma", "\"sigma\" is so large for the radius that nothing is left of the filter");
  }
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return std::fmax(0.f, gauss(offset.x) - edge_.x) * std::fmax(0.f, gauss(offset.y) - edge_.y);
  }

 private:
  float gauss(float x) const {
    return std::exp(-x * x / (2.f * sigma_ * sigma_)) / (std::sqrt(2.f * pi) * sigma_);
  }
  vec2 radius_;
  float sigma_;
  vec2 edge_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Filter, "gaussian", pssmlt::Gaussian)
