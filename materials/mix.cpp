// One of two materials at each point, chosen by the vertex's first material number.
#include <algorithm>
#include <array>

#include "core/fibre.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Mix final : public Material, public FibreMaterial {
 public:
  static constexpr const char* summary = "random choice between two named materials";

  explicit Mix(Parameters& p)
      : amount_(p.float_texture("amount", 0.5f, "", "share of the second material")) {
    const auto names = p.texts("materials", "names of the two materials");
    if (p.describing()) return;
    if (names.size() != 2) p.fail("materials", "two names of materials are needed");
    for (size_t i = 0; i < 2; ++i) parts_[i] = p.resolver().material(names[i], p.where());
    check_parts(p, names);
  }

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const override {
    const float amount = amount_->evaluate(hit);
    if (std::isnan(amount)) return invalid_bsdf(storage);
    const bool second = u.first < amount;
    // Each part gets a number that is uniform again, for mixes of mixes.
    const float rest = second ? u.first / amount : (u.first - amount) / (1.f - amount);
    MaterialNumbers inner = u;
    inner.first = std::clamp(rest, 0.f, one_minus_epsilon);
    return parts_[second]->bsdf(hit, inner, storage);
  }
  MaterialTraits traits() const override {
    const MaterialTraits a = parts_[0]->traits(), b = parts_[1]->traits();
    return {.diffuse_lobes = a.diffuse_lobes || b.diffuse_lobes,
            .delta_lobes = a.delta_lobes || b.delta_lobes,
            .transmits = a.transmits || b.transmits,
            .draws_numbers = true,
            .disperses = a.disperses || b.disperses};
  }
  bool is_of_fibres() const override {
    return pssmlt::is_of_fibres(*parts_[0]) && pssmlt::is_of_fibres(*parts_[1]);
  }
  const ShadingNormals* shading_normals() const override { return parts_[0]->shading_normals(); }

 private:
  void check_parts(const Parameters& p, const std::vector<std::string>& names) const {
    for (size_t i = 0; i < 2; ++i) {
      if (parts_[i]->traits().passes_through)
        p.fail("materials", "'" + names[i] + "' is an interface, which can't be mixed yet");
      if (parts_[i]->interior())
        p.fail("materials", "'" + names[i] + "' brings a medium, which can't be mixed");
    }
    // The shading frame is bent before the choice is made.
    if (parts_[0]->shading_normals() != parts_[1]->shading_normals())
      p.fail("materials", "materials with displacements or normal maps can't be mixed yet");
  }

  std::shared_ptr<const Texture<float>> amount_;
  std::array<std::shared_ptr<const Material>, 2> parts_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "mix", pssmlt::Mix)
