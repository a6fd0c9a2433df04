// What chains follow where relative errors matter.
#pragma once

#include "core/excess/local_mean.h"
#include "core/metropolis/chain_target.h"

namespace pssmlt {

// The luminance of all splats, each divided by the local mean where it lands (Hoberock and Hart
// 2010, Arbitrary Importance Functions for Metropolis Light Transport; two stages, as Veach 1997,
// section 11.4.3): chains then visit all parts of the picture alike, dark ones too.
class RelativeTarget final : public ChainTarget {
 public:
  explicit RelativeTarget(const LocalMean& mean) : mean_(mean) {}
  double evaluate(Splats& splats, const PixelCredit& camera) const override {
    return mean_.relative(splats, camera);
  }

 private:
  const LocalMean& mean_;
};

}  // namespace pssmlt
