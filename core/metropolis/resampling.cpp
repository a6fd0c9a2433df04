#include "core/metropolis/resampling.h"

namespace pssmlt {

std::vector<uint32_t> systematic_resample(const std::vector<double>& weights, size_t count,
                                          double u) {
  double sum = 0.0;
  size_t last = 0;  // with a weight, for what rounding leaves over
  for (size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    if (weights[i] > 0.0) last = i;
  }
  std::vector<uint32_t> chosen;
  if (!(sum > 0.0)) return chosen;
  chosen.reserve(count);
  const double spacing = sum / static_cast<double>(count);
  double cumulated = 0.0;
  for (size_t i = 0; i <= last && chosen.size() < count; ++i) {
    cumulated += weights[i];
    while (chosen.size() < count &&
           (u + static_cast<double>(chosen.size())) * spacing < cumulated) {
      chosen.push_back(static_cast<uint32_t>(i));
    }
  }
  while (chosen.size() < count) chosen.push_back(static_cast<uint32_t>(last));
  return chosen;
}

}  // namespace pssmlt
