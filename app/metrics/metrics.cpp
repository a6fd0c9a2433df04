#include "app/metrics/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "app/metrics/flip.h"
#include "app/metrics/pixel_errors.h"
#include "core/base/error.h"
#include "core/render/error_estimate.h"
#include "core/render/film.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// FLIP filters neighbourhoods: a pixel that does not count shows the same colour in both.
void fill_in(PicturePair& pair) {
  for (size_t i = 0; i < pair.pixels(); ++i) {
    if (pair.counts[i]) continue;
    if (!is_finite(pair.reference[i])) pair.reference[i] = Rgb(0.f);
    pair.picture[i] = pair.reference[i];
  }
}

ErrorMap flip_errors(const PicturePair& pair, WorkerPool& pool) {
  std::optional<PicturePair> filled;
  if (pair.non_finite > 0) fill_in(filled.emplace(pair));
  const PicturePair& p = filled ? *filled : pair;
  const Plane error =
      flip::radiance_error({p.width, p.height, p.picture}, {p.width, p.height, p.reference}, pool);
  ErrorMap map(error.values.begin(), error.values.end());
  for (size_t i = 0; i < map.size(); ++i) {
    if (!pair.counts[i]) map[i] = nan_value;
  }
  return map;
}

struct Entry {
  Metric metric;
  ErrorMap (*map)(const PicturePair& pair, WorkerPool& pool);
};

const std::array<Entry, 5> entries = {{
    {{"mse", "MSE", "mean of (x - r)^2", "squared unit of the picture"},
     [](const PicturePair& p, WorkerPool&) { return squared_errors(p); }},
    {{"relmse", "relMSE", "mean of (x - r)^2 / (r^2 + 0.01 m^2), m the mean luminance of r",
      "no unit; does not change with exposure"},
     [](const PicturePair& p, WorkerPool&) { return relative_squared_errors(p); }},
    {{"relmse_trimmed", "relMSE, trimmed", "relMSE without the 0.1 % of the pixels that are worst",
      "no unit; does not change with exposure"},
     [](const PicturePair& p, WorkerPool&) { return trimmed_relative_squared_errors(p); }},
    {{"smape", "SMAPE", "mean of |x - r| / (|x| + |r| + 0.01 m), m the mean luminance of r",
      "0 to 1; does not change with exposure"},
     [](const PicturePair& p, WorkerPool&) { return symmetric_errors(p); }},
    {{"flip", "HDR-FLIP", "mean of the largest FLIP over exposures, 67 pixels per degree",
      "0 to 1; what a viewer sees"},
     flip_errors},
}};

const std::vector<Metric>& table() {
  static const std::vector<Metric> all = [] {
    std::vector<Metric> result;
    for (const Entry& e : entries) result.push_back(e.metric);
    return result;
  }();
  return all;
}

double luminance_of(const Rgb& c) {
  return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}

void measure_bias(const PicturePair& pair, Comparison& result) {
  const BlockGrid grid({pair.width, pair.height});
  std::vector<GroupMean> blocks(static_cast<size_t>(grid.count()));
  for (size_t i = 0; i < pair.pixels(); ++i) {
    if (!pair.counts[i]) continue;
    GroupMean& block = blocks[static_cast<size_t>(grid.block(static_cast<int>(i)))];
    block.mean += luminance_of(pair.picture[i]) - luminance_of(pair.reference[i]);
    block.weight += 1.0;
  }
  for (GroupMean& block : blocks) {
    if (block.weight > 0.0) block.mean /= block.weight;
  }
  const MeanEstimate mean = estimate_mean(blocks);
  const double unit = std::abs(pair.reference_mean);
  result.mean_bias = unit > 0.0 ? mean.mean / unit : nan_value;
  result.mean_bias_error =
      unit > 0.0 && mean.groups >= 2 ? std::sqrt(mean.variance) / unit : nan_value;
}

}  // namespace

std::span<const Metric> metrics() { return table(); }

size_t metric_index(const std::string& id) {
  std::vector<std::string> ids;
  for (const Metric& m : metrics()) ids.emplace_back(m.id);
  const auto at = std::ranges::find(ids, id);
  if (at != ids.end()) return static_cast<size_t>(at - ids.begin());
  std::string list;
  for (const std::string& known : ids) list += (list.empty() ? "" : ", ") + known;
  throw Error("there is no metric \"" + id + "\"" + suggestion(id, ids) + "; there are " + list);
}

Comparison compare_images(const Image& picture, const Image& reference,
                          std::span<const std::string> ids, int threads) {
  std::array<bool, entries.size()> wanted{};
  wanted.fill(ids.empty());
  for (const std::string& id : ids) wanted[metric_index(id)] = true;
  const PicturePair pair(picture, reference);
  WorkerPool pool(threads);
  Comparison result;
  result.non_finite = pair.non_finite;
  for (size_t m = 0; m < entries.size(); ++m) {
    result.values.push_back(wanted[m] ? mean_error(entries[m].map(pair, pool)) : nan_value);
  }
  measure_bias(pair, result);
  return result;
}

Image error_map(const std::string& id, const Image& picture, const Image& reference, int threads) {
  const Entry& entry = entries[metric_index(id)];
  const PicturePair pair(picture, reference);
  WorkerPool pool(threads);
  const ErrorMap errors = entry.map(pair, pool);
  Image map(pair.width, pair.height, 1);
  map.channel_names = {"Y"};
  std::ranges::transform(errors, map.data.begin(), [](double e) { return static_cast<float>(e); });
  return map;
}

}  // namespace pssmlt
