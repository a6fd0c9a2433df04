// A surface that cannot be seen: rays go straight on (boundaries of media, shapes of lights alone).
#include "core/material.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Interface final : public Material {
 public:
  static constexpr const char* summary = "invisible surface; rays pass straight through";

  explicit Interface(Parameters&) {}
  const Bsdf* bsdf(const Hit&, MaterialNumbers, BsdfStorage&) const override { return nullptr; }
  MaterialTraits traits() const override { return {.transmits = true, .passes_through = true}; }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "interface", pssmlt::Interface)
