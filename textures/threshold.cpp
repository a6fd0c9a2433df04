// 1 where a texture reaches a value, 0 elsewhere: cut-outs from soft masks.
#include "core/plugin/plugin.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

class Threshold final : public Texture<float> {
 public:
  static constexpr const char* summary = "1 where a texture reaches a value, else 0";

  explicit Threshold(Parameters& p)
      : texture_(p.float_texture("tex", 1.f, "", "what is compared")),
        value_(p.number("value", 0.5f, "", "the least that gives 1")) {}
  float evaluate(const Hit& hit) const override {
    const float v = texture_->evaluate(hit);
    return std::isnan(v) ? v : v >= value_ ? 1.f : 0.f;
  }
  bool constant() const override { return texture_->constant(); }
  bool reads_derivatives() const override { return texture_->reads_derivatives(); }

 private:
  std::shared_ptr<const Texture<float>> texture_;
  float value_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_FLOAT_TEXTURE_PLUGIN("threshold", pssmlt::Threshold)
