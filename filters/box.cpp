// Every position within the radius counts the same. Sharp, but aliases.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 8.8.1.
#include "core/filter.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Box final : public Filter {
 public:
  static constexpr const char* summary = "Constant within its radius";

  explicit Box(Parameters& p)
      : radius_(p.number("xradius", 0.5f, "pixels", "Half width of the support in x."),
                p.number("yradius", 0.5f, "pixels", "Half width of the support in y.")) {
    if (!(radius_.x > 0.f)) p.fail("xradius", "\"xradius\" must be positive");
    if (!(radius_.y > 0.f)) p.fail("yradius", "\"yradius\" must be positive");
  }
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return std::abs(offset.x) <= radius_.x && std::abs(offset.y) <= radius_.y ? 1.f : 0.f;
  }

 private:
  vec2 radius_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Filter, "box", pssmlt::Box)
