// Do two techniques give the same picture? Welch's test block by block, with the power that the
// measured errors give it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/render_text.h"

namespace pssmlt::test {

// What a technique says about a picture: its blocks, and last the whole.
struct Blocks {
  std::vector<Estimate> estimates;
  int renders = 0;
};

inline Blocks summarise(const BlockValues& values) {
  Blocks blocks;
  blocks.renders = static_cast<int>(values.front().size());
  std::vector<double> whole(values.front().size(), 0.0);
  for (const std::vector<double>& block : values) {
    blocks.estimates.push_back(estimate(block));
    for (size_t r = 0; r < whole.size(); ++r) {
      whole[r] += block[r] / static_cast<double>(values.size());
    }
  }
  blocks.estimates.push_back(estimate(whole));
  return blocks;
}

// Largest relative standard error of a block, and of the whole.
struct Precision {
  double block = 0.0, whole = 0.0;
};
inline Precision precision(const Blocks& blocks) {
  Precision p;
  const auto relative = [](const Estimate& e) { return e.mean > 0.0 ? e.error() / e.mean : 0.0; };
  for (size_t b = 0; b + 1 < blocks.estimates.size(); ++b) {
    p.block = std::max(p.block, relative(blocks.estimates[b]));
  }
  p.whole = relative(blocks.estimates.back());
  return p;
}

// Renders until the errors are as small as asked: a pilot, whose pictures are not used otherwise,
// tells how many samples the renders need; if that was too few, more renders follow, up to eight
// times as many. The rule looks at the errors alone, which say nothing about the mean's deviation;
// that it stops at small ones makes them at most a few per cent too small, which the false alarms
// stated by the tests leave room for.
inline Blocks render_to_precision(Job job, int renders, int edge, const Precision& goal,
                                  double most_spp) {
  constexpr int pilots = 8;
  const auto excess = [&](const Precision& p) {
    return std::max(p.block / goal.block, p.whole / goal.whole);
  };
  const double rough = excess(precision(summarise(render_blocks(job, pilots, edge, 10000))));
  job.spp =
      std::clamp(std::ceil(job.spp * rough * rough * pilots / renders), job.spp / 2.0, most_spp);
  BlockValues values = render_blocks(job, renders, edge);
  Blocks blocks = summarise(values);
  while (excess(precision(blocks)) > 1.0 && blocks.renders < 8 * renders) {
    const auto next = static_cast<uint64_t>(blocks.renders) + 1;
    const BlockValues more = render_blocks(job, renders / 4, edge, next);
    for (size_t b = 0; b < values.size(); ++b) {
      values[b].insert(values[b].end(), more[b].begin(), more[b].end());
    }
    blocks = summarise(values);
  }
  return blocks;
}

struct Demand {
  double false_alarm;  // of all comparisons of one call together
  double block_error;  // relative, of a single block, found with power 0.99
  double whole_error;  // relative, of the whole picture, found with power 0.99
};

constexpr double sure = 2.3263;  // normal quantile of 0.99: the power

// Standard errors of a difference, as shares of the value, that leave the power demanded.
inline Precision allowed(const Demand& demand, size_t comparisons, int renders) {
  const double limit =
      student_limit(demand.false_alarm / static_cast<double>(comparisons), renders - 1.0);
  return {demand.block_error / (limit + sure), demand.whole_error / (limit + sure)};
}

// What the other side of a comparison with `there` must reach by at least `renders` renders. Two
// per cent are left for relative errors that differ with the mean they are taken of.
inline Precision left_over(const Demand& demand, const Blocks& there, int renders) {
  const Precision both = allowed(demand, there.estimates.size(), std::min(renders, there.renders));
  const Precision reached = precision(there);
  const auto rest = [](double a, double c) {
    return std::sqrt(std::max(0.9604 * a * a - c * c, a * a / 8.0));
  };
  return {rest(both.block, reached.block), rest(both.whole, reached.whole)};
}

// Power is that of a normal variable past the limit, with the measured errors for the true ones.
inline void expect_agreement(const Blocks& a, const Blocks& b, const Demand& demand,
                             const std::string& what) {
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  // The smaller number of degrees of freedom of the two sides alone is on the safe side.
  const double freedom = std::min(a.renders, b.renders) - 1;
  const double limit =
      student_limit(demand.false_alarm / static_cast<double>(a.estimates.size()), freedom);
  for (size_t i = 0; i < a.estimates.size(); ++i) {
    const Estimate &x = a.estimates[i], &y = b.estimates[i];
    const bool whole = i + 1 == a.estimates.size();
    const std::string where = whole ? "the whole" : "block " + std::to_string(i);
    const double error = std::sqrt(x.variance + y.variance);
    if (error == 0.0) {
      EXPECT_EQ(x.mean, y.mean) << what << ", " << where;
      continue;
    }
    EXPECT_LE(std::abs(x.mean - y.mean), limit * error)
        << what << ", " << where << ": "
        << fmt::format("{:.6g} +- {:.2g} against {:.6g} +- {:.2g}, {:.2f} % apart", x.mean,
                       x.error(), y.mean, y.error(), 100.0 * (x.mean / y.mean - 1.0));
    const double found = (limit + sure) * error / y.mean;
    EXPECT_LE(found, whole ? demand.whole_error : demand.block_error)
        << what << ", " << where << ": too noisy to find such an error with probability 0.99";
  }
}

}  // namespace pssmlt::test
