#include "core/excess/excess_split.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pssmlt {

RelativePilot::RelativePilot(const Pilot& pilot, const LocalMean& mean)
    : cells_(static_cast<size_t>(pilot.lattice().count())) {
  samples_.reserve(pilot.samples());
  splats_.reserve(pilot.all().size());
  for (size_t i = 0; i < pilot.samples(); ++i) {
    Sample sample;
    for (const PilotSplat& s : pilot.splats(i)) {
      const dvec2 raster(s.raster);
      const double value = static_cast<double>(s.value) / mean.at(raster);
      sample.sum += value;
      sample.sum_squares += value * value;
      const auto cell = static_cast<uint32_t>(pilot.lattice().at(raster));
      splats_.push_back({cell, static_cast<float>(value)});
    }
    sample.end = splats_.size();
    sample.half = pilot.sample(i).half();
    light_ += sample.sum / static_cast<double>(pilot.samples());
    light_squares_ += sqr(sample.sum) / static_cast<double>(pilot.samples());
    samples_.push_back(sample);
  }
}

double RelativePilot::light_error() const {
  const double n = std::max(1.0, static_cast<double>(samples_.size()));
  return std::sqrt(std::max(0.0, light_squares_ - sqr(light_)) / n);
}

RelativePilot::Variances RelativePilot::variances(double threshold, double stickiness) const {
  Variances v;
  std::vector<std::array<double, 2>> halves(cells_);
  double squares = 0.0, fourths = 0.0, visits = 0.0;
  size_t at = 0;
  for (const Sample& s : samples_) {
    const double kept = s.sum > threshold ? threshold / s.sum : 1.0;
    squares += kept * kept * s.sum_squares;
    fourths += sqr(kept * kept * s.sum_squares);
    for (; at < s.end; ++at) {
      halves[splats_[at].cell][s.half] += kept * static_cast<double>(splats_[at].value);
    }
    if (!(kept < 1.0)) continue;
    v.excess += s.sum - threshold;
    // A visit of a state with excess F > 0 credits b / F times its splats.
    visits += (1.0 - kept) * s.sum_squares / s.sum;
    ++v.contributing;
  }
  const double n = std::max(1.0, static_cast<double>(samples_.size()));
  double differences = 0.0;
  for (const auto& [a, b] : halves) differences += sqr(a - b);
  // Halves are sums of n / (2 cells) samples.
  v.below = std::max(differences / n, 1e-3 * squares / n);
  v.below_error = std::sqrt(fourths) / n;
  v.excess /= n;
  v.above = stickiness * v.excess * visits / n;
  return v;
}

std::vector<RelativePilot::Above> RelativePilot::above(double threshold) const {
  std::vector<Above> all;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    if (!(s.sum > threshold)) continue;
    const double kept = threshold / s.sum;
    all.push_back({s.sum - threshold, (1.0 - kept * kept) * s.sum_squares, i});
  }
  return all;
}

ExcessSplit split_at(const RelativePilot& pilot, double threshold, double stickiness) {
  ExcessSplit split;
  split.threshold = threshold;
  split.variances = pilot.variances(threshold, stickiness);
  const double below = std::sqrt(split.variances.below), above = std::sqrt(split.variances.above);
  if (above > 0.0) split.chain_share = above / (above + below);
  return split;
}

ExcessSplit choose_split(const RelativePilot& pilot, double stickiness, uint64_t least) {
  ExcessSplit best = split_at(pilot, static_cast<double>(infinity), stickiness);
  for (double threshold = 0.25; threshold < 1e9; threshold *= std::sqrt(2.0)) {
    const ExcessSplit split = split_at(pilot, threshold, stickiness);
    if (split.variances.contributing < least) break;
    if (split.variances.total() < best.variances.total()) best = split;
  }
  return best;
}

}  // namespace pssmlt
