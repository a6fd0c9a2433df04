#include "app/compare/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/compare/distributions.h"

namespace pssmlt::compare {
namespace {

// Relative differences below this are rounding.
constexpr double rounding = 1e-5;

using Rows = std::vector<std::vector<double>>;  // [group][block]

// An error common to all groups (of b) as a spread of the groups, in its deviations: the signs sum
// to zero, so that the mean stays, and `period` makes those of two techniques orthogonal.
double common_spread(size_t group, size_t groups, size_t period) {
  const double sign = group / period % 2 == 0 ? 1.0 : -1.0;
  return sign * std::sqrt(static_cast<double>(groups));
}

// Where one technique has twice as many groups as the other, its own are averaged by twos.
GroupBlocks by_twos(const GroupBlocks& g) {
  GroupBlocks result = g;
  result.means.resize(g.means.size() / 2);
  for (size_t i = 0; i < result.means.size(); ++i) {
    for (size_t k = 0; k < result.means[i].size(); ++k) {
      result.means[i][k] = 0.5 * (g.means[2 * i][k] + g.means[2 * i + 1][k]);
    }
  }
  return result;
}

// An even number of groups: with an odd one out, signs do not sum to zero.
Rows differences(const GroupBlocks& a, const GroupBlocks& b) {
  if (a.means.size() >= 2 * b.means.size() && !b.means.empty()) return differences(by_twos(a), b);
  if (b.means.size() >= 2 * a.means.size() && !a.means.empty()) return differences(a, by_twos(b));
  const size_t groups = std::min(a.means.size(), b.means.size()) / 4 * 4;
  const size_t blocks = groups == 0 ? 0 : std::min(a.means[0].size(), b.means[0].size());
  Rows d(groups, std::vector<double>(blocks));
  for (size_t g = 0; g < groups; ++g) {
    const double of_a = common_spread(g, groups, 1), of_b = common_spread(g, groups, 2);
    for (size_t k = 0; k < blocks; ++k) {
      d[g][k] = a.means[g][k] - b.means[g][k] + of_a * a.common[k] - of_b * b.common[k];
    }
  }
  return d;
}

struct Block {
  double t = 0.0;           // mean difference over its standard error
  double difference = 0.0;  // relative to the brighter one
};

double column_mean(const Rows& rows, size_t k) {
  double sum = 0.0;
  for (const auto& row : rows) sum += row[k];
  return sum / static_cast<double>(rows.size());
}

// Tests block k; leaves its column of d centred and scaled to unit variance. False if there is
// nothing to test: both are the same but for rounding.
bool test_block(Rows& d, const GroupBlocks& a, const GroupBlocks& b, size_t k, Block& block) {
  const auto n = static_cast<double>(d.size());
  const double mean = column_mean(d, k);
  const double level = std::max(column_mean(a.means, k), column_mean(b.means, k));
  double squares = 0.0;
  for (auto& row : d) {
    row[k] -= mean;
    squares += row[k] * row[k];
  }
  const double deviation = std::sqrt(squares / (n - 1.0));
  const bool same = std::fabs(mean) <= rounding * level && deviation <= rounding * level;
  for (auto& row : d) row[k] *= same || deviation == 0.0 ? 0.0 : 1.0 / deviation;
  if (same) return false;
  block.t = deviation > 0.0 ? mean / (deviation / std::sqrt(n))
                            : std::copysign(std::numeric_limits<double>::infinity(), mean);
  block.difference = mean / level;
  return true;
}

// Effective degrees of freedom of a sum of squares of `blocks` dependent normal numbers, from
// samples of them, centred and scaled to unit variance: (tr R)^2 / tr R^2.
double effective_degrees(const Rows& d, double blocks) {
  const auto n = static_cast<double>(d.size()) - 1.0;
  double squares = 0.0;  // tr S^2, by the smaller matrix of the groups' products
  double trace = 0.0;
  for (const auto& x : d) {
    for (const auto& y : d) {
      double product = 0.0;
      for (size_t k = 0; k < x.size(); ++k) product += x[k] * y[k];
      squares += product * product / (n * n);
      if (&x == &y) trace += product / n;
    }
  }
  const double corrected = n * n / ((n - 1.0) * (n + 2.0)) * (squares - trace * trace / n);
  return std::clamp(blocks * blocks / std::max(corrected, 1e-300), 1.0, blocks);
}

std::string describe(const Agreement& r, const Block& worst, int edge, const std::string& a,
                     const std::string& b, int x, int y) {
  const std::string numbers =
      fmt::format("chi-square {:.4g} on {:.4g} effective degrees of freedom, p = {:.2g}, {} blocks",
                  r.chi_square, r.degrees, *r.p_value, r.blocks);
  if (!r.biased) return fmt::format("{} and {} agree ({})", a, b, numbers);
  return fmt::format(
      "{} and {} do not agree ({}): one of them is biased, or has not found all light; the block "
      "of "
      "{} x {} pixels at ({}, {}) differs by {:+.3g} %",
      a, b, numbers, edge, edge, x, y, 100.0 * worst.difference);
}

}  // namespace

nlohmann::json to_json(const Agreement& a) {
  return {{"blocks", a.blocks},
          {"chi_square", to_json(Number(a.chi_square))},
          {"degrees", a.degrees},
          {"p_value", to_json(a.p_value)},
          {"false_alarm", bias_probability},
          {"biased", a.biased},
          {"text", a.text}};
}

Agreement test_agreement(const GroupBlocks& a, const GroupBlocks& b, const std::string& name_a,
                         const std::string& name_b) {
  Agreement result;
  Rows d = differences(a, b);
  if (static_cast<int>(d.size()) < least_test_groups) {
    result.text = "too few rounds to hold " + name_a + " and " + name_b + " against each other";
    return result;
  }
  Block worst;
  size_t worst_at = 0;
  double sum = 0.0;
  for (size_t k = 0; k < d[0].size(); ++k) {
    Block block;
    if (!test_block(d, a, b, k, block)) continue;
    const double z = normal_deviation(student_tail(block.t, static_cast<double>(d.size()) - 1.0));
    sum += z * z;
    ++result.blocks;
    if (std::fabs(block.t) <= std::fabs(worst.t)) continue;
    worst = block;
    worst_at = k;
  }
  if (result.blocks == 0) {
    result.p_value = 1.0;
    result.text = name_a + " and " + name_b + " are the same but for rounding";
    return result;
  }
  result.degrees = effective_degrees(d, result.blocks);
  result.chi_square = sum * result.degrees / result.blocks;
  result.p_value = chi_square_tail(result.chi_square, result.degrees);
  result.biased = *result.p_value < bias_probability;
  const auto across = static_cast<size_t>(a.across);
  result.text =
      describe(result, worst, a.edge, name_a, name_b, static_cast<int>(worst_at % across) * a.edge,
               static_cast<int>(worst_at / across) * a.edge);
  return result;
}

}  // namespace pssmlt::compare
