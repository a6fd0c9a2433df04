// Piecewise cubic that trades ringing (C) against blurring (B); negative lobes sharpen edges.
//
// Source: Mitchell and Netravali 1988, Reconstruction Filters in Computer Graphics, eq. 8.
#include "core/filter.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Mitchell final : public Filter {
 public:
  static constexpr const char* summary = "Mitchell-Netravali cubic with negative lobes";

  explicit Mitchell(Parameters& p)
      : radius_(p.number("xradius", 2.f, "pixels", "Half width of the support in x."),
                p.number("yradius", 2.f, "pixels", "Half width of the support in y.")),
        b_(p.number("B", 1.f / 3.f, "", "Share of the cubic B-spline (blurring).")),
        c_(p.number("C", 1.f / 3.f, "", "Share of the cardinal cubic spline (ringing).")) {
    if (!(radius_.x > 0.f)) p.fail("xradius", "\"xradius\" must be positive");
    if (!(radius_.y > 0.f)) p.fail("yradius", "\"yradius\" must be positive");
  }
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return cubic(2.f * offset.x / radius_.x) * cubic(2.f * offset.y / radius_.y);
  }

 private:
  // Equation 8, support [-2, 2].
  float cubic(float t) const {
    const float x = std::abs(t);
    if (x <= 1.f)
      return ((12.f - 9.f * b_ - 6.f * c_) * x * x * x + (-18.f + 12.f * b_ + 6.f * c_) * x * x +
              (6.f - 2.f * b_)) /
             6.f;
    if (x <= 2.f)
      return ((-b_ - 6.f * c_) * x * x * x + (6.f * b_ + 30.f * c_) * x * x +
              (-12.f * b_ - 48.f * c_) * x + (8.f * b_ + 24.f * c_)) /
             6.f;
    return 0.f;
  }
  vec2 radius_;
  float b_, c_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Filter, "mitchell", pssmlt::Mitchell)
