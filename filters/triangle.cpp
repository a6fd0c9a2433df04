// Weight falls linearly from the centre to the radius.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 8.8.2.
#include "core/filter.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Triangle final : public Filter {
 public:
  static constexpr const char* summary = "Falls linearly to its radius";

  explicit Triangle(Parameters& p)
      : radius_(p.number("xradius", 2.f, "pixels", "Half width of the support in x."),
                p.number("yradius", 2.f, "pixels", "Half width of the support in y.")) {
    if (!(radius_.x > 0.f)) p.fail("xradius", "\"xradius\" must be positive");
    if (!(radius_.y > 0.f)) p.fail("yradius", "\"yradius\" must be positive");
  }
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return std::fmax(0.f, radius_.x - std::abs(offset.x)) *
           std::fmax(0.f, radius_.y - std::abs(offset.y));
  }

 private:
  vec2 radius_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Filter, "triangle", pssmlt::Triangle)
