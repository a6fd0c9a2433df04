// The tables behind named_spectra.h; nobody else includes this.
#pragma once

#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "core/color/spectrum.h"

namespace pssmlt::named_data {

struct Entry {
  std::string_view name;
  Samples (*make)();
};

std::vector<Entry> metals();
std::vector<Entry> glasses();
std::vector<Entry> illuminants();
std::vector<Entry> fluorescent_lamps();

// Values at first, first + step, ... [nm].
inline Samples regular(float first, float step, std::span<const float> values) {
  Samples samples;
  for (size_t i = 0; i < values.size(); ++i)
    samples.emplace_back(first + step * float(i), values[i]);
  return samples;
}

}  // namespace pssmlt::named_data
