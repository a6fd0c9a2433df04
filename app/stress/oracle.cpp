#include "app/stress/oracle.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace pssmlt::stress {
namespace {

struct Estimate {
  double mean = 0.0, variance = 0.0;  // of the mean
};

Estimate estimate(const Blocks& blocks, size_t block) {
  const std::vector<double>& values = blocks.values[block];
  const auto n = static_cast<double>(values.size());
  Estimate e;
  for (const double v : values) e.mean += v / n;
  for (const double v : values) e.variance += (v - e.mean) * (v - e.mean) / (n * (n - 1.0));
  e.variance += blocks.common[block] * blocks.common[block];
  return e;
}

std::string place(size_t block, size_t count) {
  return block + 1 == count ? "the whole" : "block " + std::to_string(block);
}

// A block's tolerance may be wider than that of the whole by this factor.
constexpr double slack_of_blocks = 5.0;

// One block into the verdict of all: |difference| against the limit, relative to `expected`.
void judge(double difference, double limit, double expected, double rounding,
           const std::string& where, bool first, Comparison& all) {
  const bool whole = where == "the whole";
  const double unit = std::abs(expected) > 0.0 ? std::abs(expected) : 1.0;
  const double allowed = std::max(limit / unit, rounding), apart = std::abs(difference) / unit;
  all.widest = std::max(all.widest, whole ? allowed : allowed / slack_of_blocks);
  all.holds = all.holds && apart <= allowed;
  const auto share = [](double a, double t) { return t > 0.0 ? a / t : a > 0.0 ? 1e300 : 0.0; };
  if (!first && share(apart, allowed) <= share(all.deviation, all.tolerance)) return;
  all.deviation = apart;
  all.tolerance = allowed;
  all.where = where;
}

size_t groups_of(const Blocks& blocks) {
  return blocks.values.empty() ? 0 : blocks.values.front().size();
}

}  // namespace

double student_limit(double p, double n) {
  return boost::math::quantile(
      boost::math::complement(boost::math::students_t_distribution<double>(n), 0.5 * p));
}

Comparison compare_means(const Blocks& blocks, std::span<const double> expected, double rounding,
                         double false_alarm) {
  Comparison all;
  if (groups_of(blocks) < 2) return all;
  all.holds = true;
  std::vector<double> values(expected.begin(), expected.end());
  double mean = 0.0;
  for (const double v : expected) mean += v / static_cast<double>(expected.size());
  values.resize(expected.size() == 1 ? 0 : expected.size());
  values.push_back(mean);
  const size_t skipped = blocks.values.size() - values.size();
  const double limit = student_limit(false_alarm, static_cast<double>(groups_of(blocks)) - 1.0);
  for (size_t b = 0; b < values.size(); ++b) {
    const Estimate e = estimate(blocks, b + skipped);
    judge(e.mean - values[b], limit * std::sqrt(e.variance), values[b], rounding,
          place(b, values.size()), b == 0, all);
    all.holds = all.holds && std::isfinite(e.mean);
  }
  return all;
}

Comparison compare_blocks(const Blocks& blocks, const Blocks& reference, double factor,
                          double rounding, double false_alarm) {
  Comparison all;
  const size_t groups = std::min(groups_of(blocks), groups_of(reference));
  if (groups < 2 || blocks.values.size() != reference.values.size()) return all;
  all.holds = true;
  const double limit = student_limit(false_alarm, static_cast<double>(groups) - 1.0);
  for (size_t b = 0; b < blocks.values.size(); ++b) {
    const Estimate x = estimate(blocks, b);
    const Estimate y = estimate(reference, b);
    const double error = std::sqrt(x.variance + factor * factor * y.variance);
    judge(x.mean - factor * y.mean, limit * error, factor * y.mean, rounding,
          place(b, blocks.values.size()), b == 0, all);
    all.holds = all.holds && std::isfinite(x.mean) && std::isfinite(y.mean);
  }
  return all;
}

Comparison compare_limit(const Blocks& blocks, double most, double false_alarm) {
  Comparison all;
  if (groups_of(blocks) < 2) return all;
  const Estimate e = estimate(blocks, blocks.values.size() - 1);
  const double limit =
      student_limit(2.0 * false_alarm, static_cast<double>(groups_of(blocks)) - 1.0);
  all.where = "the whole";
  all.deviation = std::max(0.0, e.mean / most - 1.0);
  all.tolerance = all.widest = std::max(limit * std::sqrt(e.variance) / most, 2e-4);
  all.holds = e.mean >= 0.0 && all.deviation <= all.tolerance;
  return all;
}

Comparison compare_bits(const Image& image, const Image& reference, double factor) {
  Comparison all;
  if (image.width != reference.width || image.height != reference.height ||
      image.channels != reference.channels) {
    all.where = "another size";
    return all;
  }
  size_t different = 0;
  for (size_t i = 0; i < image.data.size(); ++i) {
    const double expected = static_cast<double>(reference.data[i]) * factor;
    if (static_cast<double>(image.data[i]) == expected) continue;
    ++different;
    const double apart = std::abs(static_cast<double>(image.data[i]) - expected);
    const double relative = expected != 0.0 ? apart / std::abs(expected) : 1.0;
    all.deviation = std::max(all.deviation, std::isfinite(relative) ? relative : 1e300);
  }
  all.holds = different == 0;
  all.where = fmt::format("{} of {} values differ", different, image.data.size());
  return all;
}

bool is_black(const Blocks& blocks) {
  return std::ranges::all_of(blocks.values, [](const std::vector<double>& groups) {
    return std::ranges::all_of(groups, [](double v) { return v == 0.0; });
  });
}

std::string meaning_of(const Blocks& blocks, double false_alarm) {
  return fmt::format("t-test of {} blocks, {} independent groups, false alarm {:.1g} each",
                     blocks.values.size(), groups_of(blocks), false_alarm);
}

}  // namespace pssmlt::stress
