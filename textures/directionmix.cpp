// Interpolation between two textures by the direction of the surface: snow on what lies flat, rock
// where it is steep. The weight is the cosine between the geometric normal, on either side, and a
// direction.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class DirectionMix final : public Texture<T> {
 public:
  static constexpr const char* summary = "interpolation by the direction of the surface";

  explicit DirectionMix(Parameters& p)
      : first_(value_texture<T>(p, "tex1", 0.f, "value where the normal is along dir")),
        second_(value_texture<T>(p, "tex2", 1.f, "value where it is across")) {
    const vec3 dir = p.vector("dir", {0.f, 1.f, 0.f}, "direction, in the texture's space");
    if (p.describing()) return;
    const dvec3 direction = p.transform().vector(dvec3(dir));
    if (!(glm::length(direction) > 0.0)) p.fail("dir", "\"dir\" must not be zero");
    direction_ = vec3(glm::normalize(direction));
  }
  T evaluate(const Hit& hit) const override {
    const float amount = std::abs(glm::dot(hit.ng, direction_));
    // A texture without share is not asked: it may be broken or slow there.
    if (amount == 0.f) return second_->evaluate(hit);
    if (amount == 1.f) return first_->evaluate(hit);
    return amount * first_->evaluate(hit) + (1.f - amount) * second_->evaluate(hit);
  }
  bool reads_derivatives() const override {
    return first_->reads_derivatives() || second_->reads_derivatives();
  }

 private:
  std::shared_ptr<const Texture<T>> first_, second_;
  vec3 direction_{0.f, 1.f, 0.f};  // unit, in render space
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("directionmix", pssmlt::DirectionMix)
