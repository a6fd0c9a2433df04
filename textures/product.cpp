// The product of two textures.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

template <typename T>
class Product final : public Texture<T> {
 public:
  static constexpr const char* summary = "product of two textures";

  explicit Product(Parameters& p)
      : first_(value_texture<T>(p, "tex1", 1.f, "a factor")),
        second_(value_texture<T>(p, "tex2", 1.f, "the other factor")) {}
  T evaluate(const Hit& hit) const override {
    return first_->evaluate(hit) * second_->evaluate(hit);
  }
  bool constant() const override { return first_->constant() && second_->constant(); }
  bool reads_derivatives() const override {
    return first_->reads_derivatives() || second_->reads_derivatives();
  }

 private:
  std::shared_ptr<const Texture<T>> first_, second_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("product", pssmlt::Product)
