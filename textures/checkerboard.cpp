// Squares of side 1 in (s, t), or cubes of side 1 in the texture's space, alternating between two
// textures. Edges are sharp: the picture's own filter averages them, without the bias of a guess at
// what a pixel sees.
#include <optional>

#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

// Floor is odd. Exact for any finite x, unlike a conversion to an integer.
bool is_odd(float x) {
  const float f = std::floor(x);
  return f - 2.f * std::floor(0.5f * f) != 0.f;
}

template <typename T>
class Checkerboard final : public Texture<T> {
 public:
  static constexpr const char* summary = "alternating squares or cubes of two textures";

  explicit Checkerboard(Parameters& p)
      : first_(value_texture<T>(p, "tex1", 1.f, "value at the origin's cell")),
        second_(value_texture<T>(p, "tex2", 0.f, "value of the others")),
        solid_mapping_(p) {
    const int dimension = p.integer("dimension", 2, "", "2: squares in (s, t); 3: cubes in space");
    if (dimension != 2 && dimension != 3) p.fail("dimension", "the dimension must be 2 or 3");
    if (dimension == 2) mapping_.emplace(p);
  }
  T evaluate(const Hit& hit) const override {
    return is_second(hit) ? second_->evaluate(hit) : first_->evaluate(hit);
  }
  bool reads_derivatives() const override {
    return first_->reads_derivatives() || second_->reads_derivatives();
  }

 private:
  bool is_second(const Hit& hit) const {
    if (mapping_) {
      const vec2 st = mapping_->map(hit);
      return is_odd(st.x) != is_odd(st.y);
    }
    const vec3 p = solid_mapping_.map(hit);
    return (is_odd(p.x) != is_odd(p.y)) != is_odd(p.z);
  }

  std::shared_ptr<const Texture<T>> first_, second_;
  TextureMapping3D solid_mapping_;
  std::optional<TextureMapping2D> mapping_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("checkerboard", pssmlt::Checkerboard)
