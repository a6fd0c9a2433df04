#include "core/render/replicates.h"

#include <array>
#include <cmath>

namespace pssmlt {
namespace {

using Blocks = std::vector<double>;

// sum += factor * what the group has in each block, each plane by the group's scale.
void add_group(const Film& film, const LayerScales& s, int layer, size_t group, double factor,
               Blocks& sum) {
  for (int p = 0; p < s.planes; ++p) {
    const double scale = factor * s.group[static_cast<size_t>(p)][group];
    for (size_t b = 0; b < sum.size(); ++b) {
      sum[b] += scale * film.block_sum(layer, p, static_cast<int>(group), static_cast<int>(b));
    }
  }
}

std::vector<Replicate> independent_groups(const Film& film, const LayerScales& s, int layer,
                                          size_t together) {
  std::vector<Replicate> result;
  const auto blocks = static_cast<size_t>(film.blocks().count());
  for (size_t first = 0; first < group_count; first += together) {
    Replicate r{0.0, Blocks(blocks)};
    for (size_t g = first; g < first + together; ++g) {
      if (s.group[0][g] > 0.0) r.weight += 1.0 / s.group[0][g];
    }
    if (!(r.weight > 0.0)) continue;
    for (size_t g = first; g < first + together; ++g) {
      if (!(s.group[0][g] > 0.0)) continue;
      add_group(film, s, layer, g, 1.0 / (s.group[0][g] * r.weight), r.blocks);
    }
    result.push_back(std::move(r));
  }
  return result;
}

double samples_of(const LayerScales& s, size_t group) {
  return s.group[0][group] > 0.0 ? 1.0 / s.group[0][group] : 0.0;
}

std::vector<Replicate> pairs(const Film& film, const LayerScales& s, int layer) {
  const auto blocks = static_cast<size_t>(film.blocks().count());
  std::vector<Replicate> result;
  Blocks total(blocks), mean(blocks);
  std::array<double, 2> samples{};
  for (size_t g = 0; g < group_count; ++g) samples[g % 2] += samples_of(s, g);
  const double share = samples[0] / (samples[0] + samples[1]);  // of the even half
  for (size_t c = 0; c < pair_count; ++c) {
    const double even = samples_of(s, 2 * c), odd = samples_of(s, 2 * c + 1);
    if ((even > 0.0) != (odd > 0.0)) return {};
    if (!(even > 0.0)) continue;  // a part without pixels
    // By the part's own counts, which differ from the others' while a sweep is incomplete.
    const double part = (even + odd) / (samples[0] + samples[1]);
    Blocks& difference = result.emplace_back(Replicate{1.0, Blocks(blocks)}).blocks;
    add_group(film, s, layer, 2 * c, part, difference);
    add_group(film, s, layer, 2 * c + 1, -part, difference);
    add_group(film, s, layer, 2 * c, part * even / (even + odd), total);
    add_group(film, s, layer, 2 * c + 1, part * odd / (even + odd), total);
  }
  const auto count = static_cast<double>(result.size());
  for (const Replicate& r : result) {
    for (size_t b = 0; b < blocks; ++b) mean[b] += r.blocks[b] / count;
  }
  const double spread = count * std::sqrt(share * (1.0 - share));
  for (Replicate& r : result) {
    for (size_t b = 0; b < blocks; ++b) r.blocks[b] = total[b] + spread * (r.blocks[b] - mean[b]);
  }
  return result;
}

}  // namespace

std::vector<Replicate> layer_replicates(const Film& film, const LayerScales& scales, int layer,
                                        bool as_pairs) {
  if (scales.paired) return pairs(film, scales, layer);
  return independent_groups(film, scales, layer, as_pairs ? 2 : 1);
}

std::vector<double> common_part(const Film& film, const LayerScales& s, int layer) {
  Blocks sum(static_cast<size_t>(film.blocks().count()));
  if (!(s.common_variance > 0.0)) return sum;
  for (size_t p = 0; p < s.common.size(); ++p) {
    if (!s.common[p]) continue;
    for (size_t b = 0; b < sum.size(); ++b) {
      double groups = 0.0;
      for (int g = 0; g < group_count; ++g) {
        groups += film.block_sum(layer, static_cast<int>(p), g, static_cast<int>(b));
      }
      sum[b] += s.total[p][0] * groups;
    }
  }
  return sum;
}

}  // namespace pssmlt
