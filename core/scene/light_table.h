// The choice among lights: one discrete distribution, used for emission and for next event
// estimation.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/light.h"

namespace pssmlt {

class LightTable {
 public:
  LightTable() = default;
  // Probability of a light: 0.9 by power + 0.1 uniform, so that a weak light near the camera is
  // never starved. Lights without power are left out.
  explicit LightTable(std::vector<const Light*> lights);

  struct Choice {
    const Light* light = nullptr;
    float probability = 0.f;
  };
  // light == nullptr only if there are no lights. `u` in [0,1).
  Choice choose(float u) const;
  // Probability of choosing this light; 0 if it is not in the table.
  float probability(const Light* light) const;
  const std::vector<const Light*>& all() const { return lights_; }
  const std::vector<const Light*>& infinite() const { return infinite_; }
  bool empty() const { return lights_.empty(); }

 private:
  std::vector<const Light*> lights_, infinite_;
  std::vector<float> probability_, cdf_;
  std::unordered_map<const Light*, int> index_;
};

}  // namespace pssmlt
