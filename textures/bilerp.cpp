// Bilinear interpolation between four values at the corners of the unit square in (s, t), continued
// as it is outside.
#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class Bilerp final : public Texture<T> {
 public:
  static constexpr const char* summary = "bilinear interpolation between four values";

  explicit Bilerp(Parameters& p)
      : mapping_(p),
        v00_(plain_value<T>(p, "v00", 0.f, "value at s = 0, t = 0")),
        v01_(plain_value<T>(p, "v01", 1.f, "value at s = 0, t = 1")),
        v10_(plain_value<T>(p, "v10", 0.f, "value at s = 1, t = 0")),
        v11_(plain_value<T>(p, "v11", 1.f, "value at s = 1, t = 1")) {}
  T evaluate(const Hit& hit) const override {
    const vec2 st = mapping_.map(hit);
    return (1.f - st.y) * ((1.f - st.x) * v00_ + st.x * v10_) +
           st.y * ((1.f - st.x) * v01_ + st.x * v11_);
  }
  bool reads_derivatives() const override { return false; }

 private:
  TextureMapping2D mapping_;
  T v00_, v01_, v10_, v11_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("bilerp", pssmlt::Bilerp)
