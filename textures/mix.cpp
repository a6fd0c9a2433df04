// Linear interpolation between two textures.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class Mix final : public Texture<T> {
 public:
  static constexpr const char* summary = "interpolation between two textures";

  explicit Mix(Parameters& p)
      : first_(value_texture<T>(p, "tex1", 0.f, "value where amount is 0")),
        second_(value_texture<T>(p, "tex2", 1.f, "value where amount is 1")),
        amount_(p.float_texture("amount", 0.5f, "", "share of tex2")) {}
  T evaluate(const Hit& hit) const override {
    const float amount = amount_->evaluate(hit);
    // A texture without share is not asked: it may be broken or slow there.
    if (amount == 0.f) return first_->evaluate(hit);
    if (amount == 1.f) return second_->evaluate(hit);
    return first_->evaluate(hit) * (1.f - amount) + second_->evaluate(hit) * amount;
  }
  bool constant() const override {
    return first_->constant() && second_->constant() && amount_->constant();
  }
  bool reads_derivatives() const override {
    return first_->reads_derivatives() || second_->reads_derivatives() ||
           amount_->reads_derivatives();
  }

 private:
  std::shared_ptr<const Texture<T>> first_, second_;
  std::shared_ptr<const Texture<float>> amount_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("mix", pssmlt::Mix)
