// The product of a texture and a float texture.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class Scale final : public Texture<T> {
 public:
  static constexpr const char* summary = "product of a texture and a factor";

  explicit Scale(Parameters& p)
      : texture_(value_texture<T>(p, "tex", 1.f, "what is scaled")),
        scale_(p.float_texture("scale", 1.f, "", "factor")) {}
  T evaluate(const Hit& hit) const override {
    return texture_->evaluate(hit) * scale_->evaluate(hit);
  }
  bool constant() const override { return texture_->constant() && scale_->constant(); }
  bool reads_derivatives() const override {
    return texture_->reads_derivatives() || scale_->reads_derivatives();
  }

 private:
  std::shared_ptr<const Texture<T>> texture_;
  std::shared_ptr<const Texture<float>> scale_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("scale", pssmlt::Scale)
