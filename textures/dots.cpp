// Round dots in some of the squares of side 1 in (s, t), at places that noise chooses. Edges are
// sharp, as the checkerboard's are.
//
// Source: the dots of Pharr, Jakob, Humphreys 2023, Physically Based Rendering (pbrt-v4), with its
// places and sizes. Its program exchanges "inside" and "outside"; here they are what they are
// called.
#include "core/noise.h"
#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

constexpr float radius = 0.35f;         // of a dot
constexpr float reach = 0.5f - radius;  // of its centre from the square's, at most

float flat_noise(float s, float t) { return noise({s, t, 0.5f}); }

// Squares lie around points with integer coordinates; about half of them have a dot.
bool is_in_dot(const vec2& st) {
  const vec2 square = glm::floor(st + 0.5f);
  if (!(flat_noise(square.x + 0.5f, square.y + 0.5f) > 0.f)) return false;
  const vec2 shift(flat_noise(square.x + 1.5f, square.y + 2.8f),
                   flat_noise(square.x + 4.5f, square.y + 9.8f));
  const vec2 d = st - (square + reach * shift);
  return glm::dot(d, d) < radius * radius;
}

template <typename T>
class Dots final : public Texture<T> {
 public:
  static constexpr const char* summary = "dots in some of the squares of the plane";

  explicit Dots(Parameters& p)
      : mapping_(p),
        inside_(value_texture<T>(p, "inside", 1.f, "value of the dots")),
        outside_(value_texture<T>(p, "outside", 0.f, "value around them")) {}
  T evaluate(const Hit& hit) const override {
    return is_in_dot(mapping_.map(hit)) ? inside_->evaluate(hit) : outside_->evaluate(hit);
  }
  bool reads_derivatives() const override {
    return inside_->reads_derivatives() || outside_->reads_derivatives();
  }

 private:
  TextureMapping2D mapping_;
  std::shared_ptr<const Texture<T>> inside_, outside_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("dots", pssmlt::Dots)
