#include "app/merge/weights.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace pssmlt {
namespace {

constexpr double normal_quantile = 1.959963984540054;  // 0.975

// Indices of the records of each technique; a record of several techniques is by itself.
std::vector<std::vector<size_t>> by_technique(std::span<const RenderRecord> records) {
  std::vector<std::vector<size_t>> groups;
  for (size_t i = 0; i < records.size(); ++i) {
    const auto same = [&](const std::vector<size_t>& group) {
      const RenderRecord& first = records[group.front()];
      return records[i].one_technique() && first.one_technique() &&
             records[i].parts.front().settings_hash == first.parts.front().settings_hash;
    };
    const auto at = std::ranges::find_if(groups, same);
    if (at == groups.end()) {
      groups.push_back({i});
    } else {
      at->push_back(i);
    }
  }
  return groups;
}

// Words that `more` brings and `text` does not have yet.
void add_name(std::string& text, const std::string& more) {
  if (text.empty()) {
    text = more;
  } else if ((", " + text + ", ").find(", " + more + ", ") == std::string::npos) {
    text += ", " + more;
  }
}

}  // namespace

bool share_numbers(const RenderRecord& a, const RenderRecord& b) {
  return std::ranges::any_of(a.parts, [&](const RenderPart& part) {
    return std::ranges::find(b.parts, part) != b.parts.end();
  });
}

bool share_seeds(const RenderRecord& a, const RenderRecord& b) {
  return std::ranges::any_of(a.parts, [&](const RenderPart& part) {
    return std::ranges::find(b.parts, part.seed, &RenderPart::seed) != b.parts.end();
  });
}

std::vector<double> merge_weights(std::span<const RenderRecord> records) {
  std::vector<double> weights(records.size());
  const auto groups = by_technique(records);
  double total = 0.0;
  for (const std::vector<size_t>& group : groups) {
    double samples = 0.0, error = 0.0;
    for (const size_t i : group) samples += records[i].samples;
    for (const size_t i : group) {
      weights[i] = records[i].samples / samples;
      if (groups.size() == 1) continue;
      if (!records[i].error || records[i].error->value <= 0.0) {
        throw Error("the renders are of different techniques and the error of one is not known");
      }
      error += weights[i] * weights[i] * records[i].error->value;
    }
    if (groups.size() == 1) return weights;
    for (const size_t i : group) weights[i] /= error;
    total += 1.0 / error;
  }
  for (double& w : weights) w /= total;
  return weights;
}

// An interval is that of a lognormal quantity (estimate_relative_mse()): its deviation follows from
// the ratio of its ends, and deviations of independent estimates add in squares.
std::optional<RelativeError> merged_error(std::span<const RenderRecord> records,
                                          std::span<const double> weights) {
  double value = 0.0, square = 0.0;
  for (size_t i = 0; i < records.size(); ++i) {
    const std::optional<RelativeError>& e = records[i].error;
    if (!e) return std::nullopt;
    const double part = weights[i] * weights[i] * e->value;
    value += part;
    if (e->low <= 0.0) continue;
    const double deviation = part * std::log(e->high / e->low) / (2.0 * normal_quantile);
    square += deviation * deviation;
  }
  const double factor = value > 0.0 ? std::exp(normal_quantile * std::sqrt(square) / value) : 1.0;
  return RelativeError{value, value / factor, value * factor};
}

RenderRecord merged_record(std::span<const RenderRecord> records, std::span<const double> weights,
                           bool independent) {
  RenderRecord merged = records.front();
  merged.parts.clear();
  merged.samples = merged.seconds = 0.0;
  double sum = 0.0, inverse = 0.0;
  for (size_t i = 0; i < records.size(); ++i) {
    const RenderRecord& r = records[i];
    merged.parts.insert(merged.parts.end(), r.parts.begin(), r.parts.end());
    merged.seconds += r.seconds;
    sum += r.samples;
    inverse += weights[i] * weights[i] / r.samples;
    add_name(merged.integrator, r.integrator);
    add_name(merged.sampler, r.sampler);
  }
  merged.samples = merged.one_technique() ? 1.0 / inverse : sum;
  merged.error = independent ? merged_error(records, weights) : std::nullopt;
  return merged;
}

}  // namespace pssmlt
