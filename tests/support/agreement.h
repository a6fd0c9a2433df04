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

// Renders until the errors should be as small as asked: a pilot, whose pictures are not used
// otherwise, tells how many samples the renders need.
inline Blocks render_to_precision(Job job, int renders, int edge, const Precision& goal,
                                  double most_spp) {
  constexpr int pilots = 12;
  constexpr double safety = 1.5;  // variances of a pilot are known to 40 %
  const Precision p = precision(summarise(render_blocks(job, pilots, edge, 1000)));
  const double excess = std::max(p.block / goal.block, p.whole / goal.whole);
  const double factor = safety * excess * excess * pilots / renders;
  job.spp = std::clamp(std::ceil(job.spp * factor), std::min(job.spp, 16.0), most_spp);
  return summarise(render_blocks(job, renders, edge));
}

struct Demand {
  double false_alarm;   // of all comparisons of one call together
  double block_error;   // relative, of a single block, found with power 0.99
  double whole_error;   // relative, of the whole picture, found with power 0.99
};

// Power is that of a normal variable past the limit, with the measured errors for the true ones.
inline void expect_agreement(const Blocks& a, const Blocks& b, const Demand& demand,
                             const std::string& what) {
  constexpr double sure = 2.3263;  // normal quantile of 0.99
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  // The smaller number of degrees of freedom of the two sides alone is on the safe side.
  const double freedom = std::min(a.renders, b.renders) - 1;
  const double limit =
      student_limit(demand.false_alarm / static_cast<double>(a.estimates.size()), freedom);
  std::string weak;
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
    if (found > (whole ? demand.whole_error : demand.block_error)) {
      weak += fmt::format("\n{}, {}: only an error of {:.2f} % is found with probability 0.99", what,
                          where, 100.0 * found);
    }
  }
  // Too noisy to tell is neither agreement nor disagreement.
  if (!weak.empty()) GTEST_SKIP() << "inconclusive:" << weak;
}

}  // namespace pssmlt::test
