#include "core/metropolis/excess_split.h"

#include <algorithm>
#include <cmath>

namespace pssmlt {

SplitVariances split_variances(std::span<const RelativeNorms> pilot, double threshold,
                               double stickiness) {
  SplitVariances v;
  double mean = 0.0, visits = 0.0;
  for (const RelativeNorms& r : pilot) {
    if (!(r.sum > 0.0)) continue;
    const double kept = std::min(1.0, threshold / r.sum);
    v.below += kept * kept * r.sum_squares;
    mean += kept * r.sum;
    if (!(kept < 1.0)) continue;
    v.excess += r.sum - threshold;
    // A visit of a state with excess F > 0 credits b / F times its splats.
    visits += (1.0 - kept) * r.sum_squares / r.sum;
    ++v.contributing;
  }
  const double n = std::max(1.0, static_cast<double>(pilot.size()));
  mean /= n;
  v.excess /= n;
  // What a pixel's own samples have in common is not noise.
  v.below = std::max(v.below / n - mean * mean, 1e-3 * v.below / n);
  v.above = stickiness * v.excess * visits / n;
  return v;
}

ExcessSplit split_at(std::span<const RelativeNorms> pilot, double threshold, double stickiness) {
  const SplitVariances v = split_variances(pilot, threshold, stickiness);
  ExcessSplit split;
  split.threshold = threshold;
  split.excess = v.excess;
  split.contributing = v.contributing;
  const double below = std::sqrt(v.below), above = std::sqrt(v.above);
  if (above > 0.0) split.chain_share = above / (above + below);
  return split;
}

ExcessSplit choose_split(std::span<const RelativeNorms> pilot, double stickiness, uint64_t least) {
  ExcessSplit best;
  double total = 0.0;
  const auto root_sum = [&](double threshold) {
    const SplitVariances v = split_variances(pilot, threshold, stickiness);
    total = std::sqrt(v.below) + std::sqrt(v.above);
    return v.contributing;
  };
  root_sum(best.threshold);
  double least_total = total;
  for (double threshold = 0.25; threshold < 1e9; threshold *= std::sqrt(2.0)) {
    if (root_sum(threshold) < least) break;
    if (!(total < least_total)) continue;
    least_total = total;
    best = split_at(pilot, threshold, stickiness);
  }
  return best;
}

}  // namespace pssmlt
