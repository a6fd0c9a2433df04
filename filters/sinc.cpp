// The ideal low-pass filter under a Lanczos window: sharp, rings at strong edges.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 8.8.5.
#include "core/filter.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class WindowedSinc final : public Filter {
 public:
  static constexpr const char* summary = "Sinc under a Lanczos window, with negative lobes";

  explicit WindowedSinc(Parameters& p)
      : radius_(p.number("xradius", 4.f, "pixels", "Half width of the support in x."),
                p.number("yradius", 4.f, "pixels", "Half width of the support in y.")),
        tau_(p.number("tau", 3.f, "cycles", "Cycles of the sinc before the window ends.")) {
    if (!(radius_.x > 0.f)) p.fail("xradius", "\"xradius\" must be positive");
    if (!(radius_.y > 0.f)) p.fail("yradius", "\"yradius\" must be positive");
    if (!(tau_ > 0.f)) p.fail("tau", "\"tau\" must be positive");
  }
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return windowed(offset.x, radius_.x) * windowed(offset.y, radius_.y);
  }

 private:
  // sin(pi x) / (pi x), by its series where the quotient would lose digits.
  static float sinc(float x) {
    const float t = pi * x;
    return std::abs(t) < 1e-2f ? 1.f - t * t / 6.f : std::sin(t) / t;
  }
  float windowed(float x, float r) const {
    return std::abs(x) > r ? 0.f : sinc(x) * sinc(x / tau_);
  }
  vec2 radius_;
  float tau_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Filter, "sinc", pssmlt::WindowedSinc)
