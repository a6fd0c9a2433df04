#include "core/render/efficiency.h"

#include <algorithm>
#include <vector>

namespace pssmlt {
namespace {

constexpr size_t least_regions = 4;

PixelRegion region_of(const Film& film, int block) {
  const ivec2 size = film.settings().size;
  const int edge = film.blocks().edge(), across = (size.x + edge - 1) / edge;
  const int x = block % across * edge, y = block / across * edge;
  return {x, y, std::min(x + edge, size.x) - 1, std::min(y + edge, size.y) - 1};
}

// A block's light by each group alone, in the same unit for all blocks.
struct BlockLight {
  double mean = 0.0, variance_of_mean = 0.0;
};

BlockLight block_light(const Film& film, const LayerScales& scales, int layer, int block) {
  std::array<double, group_count> light{};
  BlockLight result;
  for (size_t g = 0; g < light.size(); ++g) {
    for (int p = 0; p < scales.planes; ++p) {
      if (!scales.sampler->is_chain_plane(p)) continue;
      light[g] += film.block_sum(layer, p, static_cast<int>(g), block) *
                  scales.group[static_cast<size_t>(p)][g];
    }
    result.mean += light[g] / group_count;
  }
  for (const double x : light) {
    const double d = x - result.mean;
    result.variance_of_mean += d * d / (group_count * (group_count - 1.0));
  }
  return result;
}

double weighted_median(std::vector<RegionEfficiency> regions) {
  const auto less = [](const auto& a, const auto& b) { return a.effective < b.effective; };
  std::sort(regions.begin(), regions.end(), less);
  double all = 0.0, sum = 0.0;
  for (const RegionEfficiency& r : regions) all += r.share;
  for (const RegionEfficiency& r : regions) {
    sum += r.share;
    if (sum >= 0.5 * all) return r.effective;
  }
  return regions.back().effective;
}

}  // namespace

std::string to_string(const PixelRegion& r) {
  return "pixels x " + std::to_string(r.x0) + " to " + std::to_string(r.x1) + ", y " +
         std::to_string(r.y0) + " to " + std::to_string(r.y1);
}

std::optional<ChainEfficiency> chain_efficiency(const Film& film, const LayerScales& scales,
                                                int layer, int64_t rounds) {
  const double mutations = scales.sampler->mutations(rounds);
  const auto missing = [](double scale) { return scale <= 0.0; };
  if (!(mutations > 0.0)) return std::nullopt;
  if (std::any_of(scales.group[0].begin(), scales.group[0].end(), missing)) return std::nullopt;
  std::vector<BlockLight> blocks;
  std::vector<double> visits;
  double all = 0.0;
  for (int b = 0; b < film.blocks().count(); ++b) {
    const PixelRegion r = region_of(film, b);
    blocks.push_back(block_light(film, scales, layer, b));
    visits.push_back(blocks.back().mean *
                     scales.sampler->visits(0.5 * dvec2(r.x0 + r.x1 + 1, r.y0 + r.y1 + 1)));
    all += visits.back();
  }
  std::vector<RegionEfficiency> regions;
  double light = 0.0;
  for (const BlockLight& b : blocks) light += b.mean;
  for (size_t b = 0; b < blocks.size(); ++b) {
    const double q = visits[b] / all;
    if (!(q > 0.0 && q < 1.0 && blocks[b].variance_of_mean > 0.0)) continue;
    const double relative = blocks[b].variance_of_mean / (blocks[b].mean * blocks[b].mean);
    const double effective = (1.0 - q) / (q * mutations * relative);
    regions.push_back({region_of(film, static_cast<int>(b)), blocks[b].mean / light, effective});
  }
  if (regions.size() < least_regions) return std::nullopt;
  const auto less = [](const auto& a, const auto& b) { return a.effective < b.effective; };
  ChainEfficiency result;
  result.worst = *std::min_element(regions.begin(), regions.end(), less);
  result.median = weighted_median(regions);
  result.regions = static_cast<int>(regions.size());
  return result;
}

}  // namespace pssmlt
