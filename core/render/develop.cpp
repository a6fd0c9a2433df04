#include "core/render/develop.h"

#include <algorithm>
#include <cmath>

#include "core/render/relative_denominators.h"
#include "core/render/replicates.h"

namespace pssmlt {
namespace {

constexpr double most_degrees = 1e6;  // of freedom: as good as any number
constexpr int strip = 4096;           // pixels that one thread develops at a time

// A half's sum times this is an estimate of the whole: samples add up, scales are their inverse.
std::array<double, 2> half_scales(const std::array<double, group_count>& group) {
  std::array<double, 2> samples{};
  for (size_t g = 0; g < group.size(); ++g) {
    if (group[g] > 0.0) samples[g % 2] += 1.0 / group[g];
  }
  return {samples[0] > 0.0 ? 1.0 / samples[0] : 0.0, samples[1] > 0.0 ? 1.0 / samples[1] : 0.0};
}

}  // namespace

LayerScales::LayerScales(const Sampler& s, int64_t rounds)
    : planes(s.planes()),
      common_variance(s.scale_relative_variance()),
      correlated(s.correlates_pixels()),
      paired(s.pairs_groups()),
      sampler(&s) {
  for (int p = 0; p < planes; ++p) {
    common.push_back(s.is_chain_plane(p));
    auto& scales = total.emplace_back();
    for (int subset = 0; subset < s.subsets(); ++subset) {
      scales.push_back(s.scale(p, subset, rounds));
    }
    auto& groups = group.emplace_back();
    for (int g = 0; g < group_count; ++g) {
      groups[static_cast<size_t>(g)] = s.group_scale(p, g, rounds);
    }
    half.push_back(half_scales(groups));
  }
  balance = 0.0;
  if (half[0][0] > 0.0 && half[0][1] > 0.0) {
    const double share = half[0][1] / (half[0][0] + half[0][1]);
    balance = share * (1.0 - share);
  }
  unknown = s.unknown_error();
  if (unknown.empty() && !std::isfinite(common_variance)) unknown = "b is not finite";
}

double LayerScales::group_samples() const {
  if (!paired) return group_count;
  double sweeps = 0.0;
  for (const double scale : group[0]) sweeps += scale > 0.0 ? 1.0 / scale : 0.0;
  return sweeps;
}

Developer::Developer(const Film& film, std::vector<LayerScales> layers, double picture_scale,
                     const glm::dmat3& balance)
    : film_(film),
      layers_(std::move(layers)),
      picture_scale_(picture_scale),
      to_picture_(picture_scale * balance) {
  for (const LayerScales& l : layers_) {
    auto& subsets = subset_of_.emplace_back();
    if (l.sampler->subsets() == 1) continue;
    for (int p = 0; p < film.pixels(); ++p) {
      subsets.push_back(static_cast<uint8_t>(l.sampler->subset_of(p)));
    }
  }
}

// Pixels [begin, end).
template <typename Value>
void Developer::fill(Image& image, int begin, int end, const Value& value) const {
  for (int p = begin; p < end; ++p) {
    const dvec3 v = value(p);
    for (int c = 0; c < 3; ++c) {
      image.data[static_cast<size_t>(p) * 3 + static_cast<size_t>(c)] = static_cast<float>(v[c]);
    }
  }
}

template <typename Value>
Image Developer::image(const Value& value) const {
  const ivec2 size = film_.settings().size;
  Image result(size.x, size.y, 3);
  fill(result, 0, film_.pixels(), value);
  return result;
}

dvec3 Developer::pixel(int p) const {
  dvec3 sum(0.0);
  for (size_t l = 0; l < layers_.size(); ++l) {
    const size_t subset = subset_of_[l].empty() ? 0 : subset_of_[l][static_cast<size_t>(p)];
    for (int plane = 0; plane < layers_[l].planes; ++plane) {
      const int layer = static_cast<int>(l);
      const dvec3 both = film_.value(layer, plane, 0, p) + film_.value(layer, plane, 1, p);
      sum += both * layers_[l].total[static_cast<size_t>(plane)][subset];
    }
  }
  return to_picture_ * sum;
}

dvec3 Developer::half_pixel(int p, int layer, int which) const {
  dvec3 sum(0.0);
  const LayerScales& l = layers_[static_cast<size_t>(layer)];
  for (int plane = 0; plane < l.planes; ++plane) {
    sum += film_.value(layer, plane, which, p) *
           l.half[static_cast<size_t>(plane)][static_cast<size_t>(which)];
  }
  return to_picture_ * sum;
}

dvec3 Developer::variance_pixel(int p) const {
  dvec3 sum(0.0);
  for (int l = 0; l < film_.layers(); ++l) {
    const dvec3 d = half_pixel(p, l, 0) - half_pixel(p, l, 1);
    sum += d * d * layers_[static_cast<size_t>(l)].balance;
  }
  return sum;
}

Image Developer::picture() const {
  return image([this](int p) { return pixel(p); });
}

Image Developer::picture(WorkerPool& pool) const {
  const ivec2 size = film_.settings().size;
  Image result(size.x, size.y, 3);
  const int strips = (film_.pixels() + strip - 1) / strip;
  pool.run(strips, [&](int unit, int) {
    const int begin = unit * strip, end = std::min(begin + strip, film_.pixels());
    fill(result, begin, end, [this](int p) { return pixel(p); });
  });
  return result;
}

Image Developer::half(int which) const {
  for (const LayerScales& l : layers_) {
    if (!l.halves_known()) return {};
  }
  return image([&](int p) {
    dvec3 sum(0.0);
    for (int l = 0; l < film_.layers(); ++l) sum += half_pixel(p, l, which);
    return sum;
  });
}

Image Developer::variance() const {
  for (const LayerScales& l : layers_) {
    if (!l.halves_known() || !l.unknown.empty()) return {};
  }
  return image([this](int p) { return variance_pixel(p); });
}

std::vector<SplitImage> Developer::splits(SplitKind kind) const {
  std::vector<SplitImage> result;
  for (const int index : film_.split_indices(kind)) {
    const auto value = [&](int p) {
      dvec3 sum(0.0);
      for (size_t l = 0; l < layers_.size(); ++l) {
        const size_t subset = subset_of_[l].empty() ? 0 : subset_of_[l][static_cast<size_t>(p)];
        for (int plane = 0; plane < layers_[l].planes; ++plane) {
          sum += film_.split_value(kind, index, static_cast<int>(l), plane, p) *
                 layers_[l].total[static_cast<size_t>(plane)][subset];
        }
      }
      return to_picture_ * sum;
    };
    const std::string name =
        kind == SplitKind::length
            ? "length" + std::to_string(index)
            : "s" + std::to_string(index / split_edge) + "t" + std::to_string(index % split_edge);
    result.push_back({name, image(value)});
  }
  return result;
}

double GroupBlocks::common_variance() const {
  double mean = 0.0, deviation = 0.0;
  for (const auto& row : means) {
    for (const double value : row) mean += value / static_cast<double>(means.size());
  }
  for (const double block : common) deviation += block;
  return mean > 0.0 ? sqr(deviation / mean) : 0.0;
}

// Layers have each a factor of their own; which blocks these move together is not told apart.
void Developer::add_common(int layer, const std::vector<double>& pixels, Blocks& common) const {
  const LayerScales& scales = layers_[static_cast<size_t>(layer)];
  const Blocks part = common_part(film_, scales, layer);
  for (size_t b = 0; b < pixels.size(); ++b) {
    const double own = std::sqrt(scales.common_variance) * part[b] * picture_scale_ / pixels[b];
    common[b] = std::hypot(common[b], own);
  }
}

GroupBlocks Developer::group_blocks() const {
  const BlockGrid& grid = film_.blocks();
  GroupBlocks result;
  result.edge = grid.edge();
  result.across = (film_.settings().size.x + grid.edge() - 1) / grid.edge();
  std::vector<double> pixels(static_cast<size_t>(grid.count()));
  for (int p = 0; p < film_.pixels(); ++p) pixels[static_cast<size_t>(grid.block(p))] += 1.0;
  result.common.assign(pixels.size(), 0.0);
  const bool paired =
      std::any_of(layers_.begin(), layers_.end(), [](const LayerScales& l) { return l.paired; });
  for (int l = 0; l < film_.layers(); ++l) {
    const std::vector<Replicate> own =
        layer_replicates(film_, layers_[static_cast<size_t>(l)], l, paired);
    add_common(l, pixels, result.common);
    if (l == 0) result.means.assign(own.size(), std::vector<double>(pixels.size()));
    result.means.resize(std::min(result.means.size(), own.size()));
    for (size_t g = 0; g < result.means.size(); ++g) {
      for (size_t b = 0; b < pixels.size(); ++b) {
        result.means[g][b] += own[g].blocks[b] * picture_scale_ / pixels[b];
      }
    }
  }
  return result;
}

ErrorEstimate Developer::error() const {
  ErrorEstimate estimate;
  for (const LayerScales& l : layers_) {
    if (!l.unknown.empty()) estimate.why = l.unknown;
  }
  if (!estimate.why.empty()) return estimate;
  estimate_picture_mean(estimate);
  if (!estimate.mean_known) {
    estimate.why = "fewer than " + std::to_string(least_groups) + " groups of samples";
    return estimate;
  }
  estimate_pixels(estimate);
  return estimate;
}

double Developer::common_variance(int layer) const {
  const LayerScales& scales = layers_[static_cast<size_t>(layer)];
  double sum = 0.0;
  for (const double block : common_part(film_, scales, layer)) sum += block;
  return scales.common_variance * sqr(sum * picture_scale_ / film_.pixels());
}

void Developer::estimate_picture_mean(ErrorEstimate& estimate) const {
  double variance = 0.0, uncertain = 0.0;
  int least = group_count;
  bool known = true;
  for (int l = 0; l < film_.layers(); ++l) {
    const LayerScales& layer = layers_[static_cast<size_t>(l)];
    std::vector<GroupMean> groups;
    for (const Replicate& r : layer_replicates(film_, layer, l, false)) {
      double sum = 0.0;
      for (const double block : r.blocks) sum += block;
      groups.push_back({sum * picture_scale_ / film_.pixels(), r.weight});
    }
    const MeanEstimate m = estimate_mean(groups);
    least = std::min(least, m.groups);
    known = known && layer.group_samples() >= least_groups;
    estimate.mean += m.mean;
    variance += m.variance + common_variance(l);
    if (m.groups > 1) uncertain += m.variance * m.variance / (m.groups - 1.0);
  }
  estimate.mean_known = known && least >= least_groups;
  if (!estimate.mean_known) return;
  estimate.mean_error = std::sqrt(variance);
  // Welch and Satterthwaite; b's variance, from very many samples, is known beside the groups'.
  const double degrees =
      uncertain > 0.0 ? std::min(variance * variance / uncertain, most_degrees) : most_degrees;
  const double half_width = student_quantile(degrees) * estimate.mean_error;
  estimate.mean_low = estimate.mean - half_width;
  estimate.mean_high = estimate.mean + half_width;
}

void Developer::estimate_pixels(ErrorEstimate& estimate) const {
  bool correlated = false;
  double common = 0.0;
  for (int l = 0; l < film_.layers(); ++l) {
    correlated = correlated || layers_[static_cast<size_t>(l)].correlated;
    if (estimate.mean > 0.0) common += common_variance(l) / sqr(estimate.mean);
  }
  // Where errors of neighbours are correlated a block is one cell. Otherwise a pixel is.
  const BlockGrid& grid = film_.blocks();
  std::vector<double> cells(static_cast<size_t>(correlated ? grid.count() : film_.pixels()));
  const double epsilon = relative_mse_epsilon * estimate.mean * estimate.mean;
  double energy = 0.0;
  const Image variances = variance();
  const Image value = picture();
  const std::vector<double> denominators = relative_denominators(value, half(0), half(1), epsilon);
  for (int p = 0; p < film_.pixels(); ++p) {
    double& cell = cells[static_cast<size_t>(correlated ? grid.block(p) : p)];
    for (size_t c = 3 * static_cast<size_t>(p); c < 3 * static_cast<size_t>(p) + 3; ++c) {
      if (denominators[c] <= 0.0) continue;
      cell += static_cast<double>(variances.data[c]) / denominators[c];
      energy += std::min(1.0, sqr(static_cast<double>(value.data[c])) / denominators[c]);
    }
  }
  const double count = 3.0 * film_.pixels();
  estimate_relative_mse(cells, count, common * energy / count, estimate);
}

}  // namespace pssmlt
