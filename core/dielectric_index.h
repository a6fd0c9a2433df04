// The refractive index of dielectric materials, as scenes give it.
#pragma once

#include "core/color/spectrum.h"
#include "core/scene/parameters.h"

namespace pssmlt {

class DielectricIndex {
 public:
  // Reads `name`: a number, a colour whose components are alike, or a spectrum. Positive at all
  // wavelengths; throws Error otherwise.
  explicit DielectricIndex(Parameters& p, const char* name = "eta", float fallback = 1.5f);
  // At 587.6 nm, the d line of helium, where glasses are specified.
  float at_d() const { return at_d_; }
  bool varies() const { return !samples_.empty(); }
  float at(float nanometres) const {
    if (!varies()) return at_d_;
    return static_cast<float>(evaluate(samples_, static_cast<double>(nanometres), Outside::Clamp));
  }

 private:
  float at_d_ = 1.5f;
  Samples samples_;  // empty: the same everywhere
};

// The index at the d line, with a log line if it varies: for materials that do not disperse.
float read_dielectric_index(Parameters& p, const char* name = "eta", float fallback = 1.5f);

}  // namespace pssmlt
