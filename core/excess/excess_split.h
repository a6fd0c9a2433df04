// Where to cut bright samples off, and how much of the work to spend on what is cut off.
//
// A sample worth r local means is split into r min(1, T / r), which Sobol' points integrate, and
// r max(0, 1 - T / r), which chains do (in the spirit of Bitterli and Jarosz 2019, Selectively
// Metropolised Monte Carlo light transport simulation). With the variances V1(T) and V2(T) of one
// sample of either kind, n samples shared in proportion to their roots leave
// (sqrt V1 + sqrt V2)^2 / n, which is least at some T; T = infinity is plain sampling.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/math.h"
#include "core/excess/local_mean.h"

namespace pssmlt {

// A pilot relative to the local mean.
class RelativePilot {
 public:
  RelativePilot(const Pilot& pilot, const LocalMean& mean);
  size_t samples() const { return samples_.size(); }
  // Mean of all samples [local means], and its standard error were they independent.
  double light() const { return light_; }
  double light_error() const;

  // What the samples above T are worth above it [local means], and how much that adds to the sum of
  // the squares of what they put into pixels.
  struct Above {
    double value = 0.0, squares = 0.0;
    size_t sample = 0;  // of the pilot
  };
  std::vector<Above> above(double threshold) const;
  // At a given T, relative to the local mean and averaged over the picture. V1 comes from the
  // difference of the pilot's halves cell by cell: what a pixel's samples have in common is not
  // noise, and Sobol' points are better than independent ones. stickiness: how many mutations of a
  // chain are worth one independent sample of what it follows.
  struct Variances {
    double below = 0.0, above = 0.0;
    double below_error = 0.0;   // standard error of V1, were samples independent
    double excess = 0.0;        // mean of what is cut off [local means]
    uint64_t contributing = 0;  // samples above T
    double total() const { return sqr(std::sqrt(below) + std::sqrt(above)); }
  };
  Variances variances(double threshold, double stickiness) const;

 private:
  struct Sample {
    size_t end = 0;  // one past its last splat
    uint32_t half = 0;
    double sum = 0.0, sum_squares = 0.0;  // of its splats
  };
  struct Cell {
    uint32_t cell = 0;
    float value = 0.f;  // [local means]
  };
  size_t cells_ = 1;
  double light_ = 0.0, light_squares_ = 0.0;  // means
  std::vector<Sample> samples_;
  std::vector<Cell> splats_;
};

struct ExcessSplit {
  double threshold = static_cast<double>(infinity);  // T [local means]
  double chain_share = 0.0;                          // of all samples
  RelativePilot::Variances variances;
};
// The best T of a geometric series. One above which the pilot has fewer than `least` samples is not
// considered: what is cut off has to be known.
ExcessSplit choose_split(const RelativePilot& pilot, double stickiness, uint64_t least);
// The best share for a given T.
ExcessSplit split_at(const RelativePilot& pilot, double threshold, double stickiness);

}  // namespace pssmlt
