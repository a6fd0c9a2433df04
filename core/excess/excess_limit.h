// A limit on samples, in local means, and what lies on either side of it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/excess/local_mean.h"
#include "core/metropolis/chain_target.h"

namespace pssmlt {

struct ExcessLimit {
  const LocalMean* mean = nullptr;
  double threshold = static_cast<double>(infinity);  // [local means]
  bool finite() const { return std::isfinite(threshold); }
  // Leaves of a sample what is below the limit. Returns what was above [local means].
  double keep_below(Splats& splats, const PixelCredit& camera) const {
    if (!finite()) return 0.0;
    const double r = mean->relative(splats, camera);
    if (!(r > threshold)) return 0.0;
    splats.scale(static_cast<float>(threshold / r));
    return r - threshold;
  }
};

// What is above, for chains: they follow its sum relative to the local means.
class AboveLimit final : public ChainTarget {
 public:
  explicit AboveLimit(const ExcessLimit& limit) : limit_(limit) {}
  double evaluate(Splats& splats, const PixelCredit& camera) const override {
    const double r = limit_.mean->relative(splats, camera);
    const double rest = std::max(0.0, r - limit_.threshold);
    splats.scale(rest > 0.0 ? static_cast<float>(rest / r) : 0.f);
    return rest;
  }

 private:
  const ExcessLimit& limit_;
};

}  // namespace pssmlt
