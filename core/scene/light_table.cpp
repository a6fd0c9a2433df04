#include "core/scene/light_table.h"

#include <algorithm>
#include <cmath>

namespace pssmlt {

LightTable::LightTable(std::vector<const Light*> lights) {
  std::vector<double> power;
  double total = 0.0;
  for (const Light* light : lights) {
    const double p = static_cast<double>(light->power());
    if (!(p > 0.0)) continue;
    lights_.push_back(light);
    // An infinite sum would leave every finite light without a share.
    power.push_back(std::min(p, static_cast<double>(std::numeric_limits<float>::max())));
    total += power.back();
    const EndpointTraits traits = light->traits();
    if (traits.infinite && !traits.delta_direction) infinite_.push_back(light);
  }
  double sum = 0.0;
  for (size_t i = 0; i < lights_.size(); ++i) {
    const double p = 0.9 * power[i] / total + 0.1 / static_cast<double>(lights_.size());
    sum += p;
    probability_.push_back(static_cast<float>(p));
    cdf_.push_back(static_cast<float>(sum));
    index_.emplace(lights_[i], static_cast<int>(i));
  }
  // What choose() does is the truth: probabilities are the differences of the rounded sums.
  if (!cdf_.empty()) cdf_.back() = 1.f;
  for (size_t i = 0; i < cdf_.size(); ++i)
    probability_[i] = i == 0 ? cdf_[0] : cdf_[i] - cdf_[i - 1];
}

LightTable::Choice LightTable::choose(float u) const {
  if (lights_.empty()) return {};
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end() - 1, u);
  const auto i = static_cast<size_t>(above - cdf_.begin());
  return {lights_[i], probability_[i]};
}

float LightTable::probability(const Light* light) const {
  const auto found = index_.find(light);
  return found == index_.end() ? 0.f : probability_[static_cast<size_t>(found->second)];
}

}  // namespace pssmlt
