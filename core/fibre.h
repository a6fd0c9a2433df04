// What materials and shapes of fibres agree on. A material of fibres scatters light once where a
// path crosses one, as if the fibre were a line with a width; on a closed tube it would scatter
// where the path enters and again where it leaves.
#pragma once

#include "core/material.h"

namespace pssmlt {

// A material that also derives from this is meant for fibres: shapes that have a parameter "bool
// sheet" get it set, unless the scene gives it.
class FibreMaterial {
 public:
  virtual ~FibreMaterial() = default;
  // False for what combines other materials if one of them is not.
  virtual bool is_of_fibres() const { return true; }
};
inline bool is_of_fibres(const Material& material) {
  const auto* const fibres = dynamic_cast<const FibreMaterial*>(&material);
  return fibres && fibres->is_of_fibres();
}

// The name of that parameter.
inline constexpr const char* fibre_parameter = "sheet";

}  // namespace pssmlt
