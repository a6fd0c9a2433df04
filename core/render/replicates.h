// Independent estimates of a layer's light in every block of pixels: what tells the error of a
// picture's and of a block's mean, by Student's t.
#pragma once

#include <vector>

#include "core/render/develop.h"

namespace pssmlt {

// In units of the film, sums over the pixels of a block.
struct Replicate {
  double weight = 1.0;  // proportional to its number of samples
  std::vector<double> blocks;
};

// Of groups that are independent: each one's own estimate; with `as_pairs`, two of them averaged,
// so that there are as many as pairs are. Of groups that come in pairs, whose differences D_c add
// up to that of the halves: the estimate T by all samples, plus C sqrt(s0 s1) (D_c - mean of D),
// where C is the number of pairs and s0, s1 the halves' shares of the samples. Their mean is T, and
// the variance that they state for it is s0 s1 times the sum of the D's variances, which is T's.
// Empty if a half of some pair has no samples yet.
std::vector<Replicate> layer_replicates(const Film& film, const LayerScales& scales, int layer,
                                        bool as_pairs);

// Sums over the pixels of each block, in units of the film, of the planes whose factor is common to
// all groups (LayerScales::common).
std::vector<double> common_part(const Film& film, const LayerScales& scales, int layer);

}  // namespace pssmlt
