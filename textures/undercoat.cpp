// The reflectance of a base that, under a dielectric coat, shows the colour of another texture.
// Materials of older formats put a diffuse lobe beside a glossy one; under a coat the same colour
// would be darker and more saturated by what the coat holds back.
//
// The relation is that of core/coat.h, solved for the base, for diffuse illumination and view.
#include "core/coat.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"
#include "core/texture.h"

namespace pssmlt {
namespace {

class Undercoat final : public Texture<Rgb> {
 public:
  static constexpr const char* summary = "base that shows a colour through a coat";

  explicit Undercoat(Parameters& p)
      : seen_(p.rgb_texture("tex", Rgb(0.5f), SpectrumUse::Albedo, "", "the colour to be seen")),
        eta_(p.number("eta", 1.5f, "", "refractive index of the coat")) {
    const float thickness =
        p.number("thickness", 0.01f, "", "of the coat, in mean free paths of its medium");
    const float width = p.number("width", 0.f, "", "of the coat's lobe (GGX alpha)");
    if (!(eta_ > 1.f)) p.fail("eta", "\"eta\" must be above 1");
    if (!(thickness >= 0.f)) p.fail("thickness", "\"thickness\" must not be negative");
    if (!(width >= 0.f && width <= 1.f)) p.fail("width", "\"width\" must lie between 0 and 1");
    if (p.describing()) return;
    coat_.emplace(eta_, thickness, width);
  }

  Rgb evaluate(const Hit& hit) const override {
    return coat_->base_of(clamp_reflectance(seen_->evaluate(hit)), eta_);
  }
  bool constant() const override { return seen_->constant(); }
  bool reads_derivatives() const override { return seen_->reads_derivatives(); }

 private:
  std::shared_ptr<const Texture<Rgb>> seen_;
  float eta_;
  std::optional<Coat> coat_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_SPECTRUM_TEXTURE_PLUGIN("undercoat", pssmlt::Undercoat)
