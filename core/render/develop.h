// From the film's sums to pictures: each sampler's scales, halves, variance, images by path.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/render/error_estimate.h"
#include "core/render/film.h"
#include "core/render/worker_pool.h"

namespace pssmlt {

// What develop() must know of a layer: its sampler's scales after so many rounds.
struct LayerScales {
  LayerScales(const Sampler& sampler, int64_t rounds);
  int planes = 1;
  std::vector<std::vector<double>> total;              // [plane][subset]
  std::vector<std::array<double, 2>> half;             // [plane][half]; 0: the half has nothing yet
  std::vector<std::array<double, group_count>> group;  // [plane][group]; 0: nothing yet
  double balance = 0.25;         // product of the halves' shares of the samples
  std::vector<bool> common;      // [plane] has a factor in common with all groups (b)
  double common_variance = 0.0;  // relative, of that factor
  bool correlated = false;
  bool paired = false;  // Sampler::pairs_groups()
  std::string unknown;  // Sampler::unknown_error()
  const Sampler* sampler = nullptr;
  bool halves_known() const { return balance > 0.0; }
  // Of paired groups: samples a pixel, of which groups say nothing; else as many as there are
  // groups.
  double group_samples() const;
};

// A picture per path length or strategy.
struct SplitImage {
  std::string name;  // "length2", "s1t3"
  Image image;
};

// Mean luminance of every block of pixels as independent estimates of it
// (core/render/replicates.h).
struct GroupBlocks {
  int edge = 16, across = 1;               // of a block [pixels]; blocks in a row
  std::vector<std::vector<double>> means;  // [estimate][block]
  // [block] standard deviation [W/(m^2 sr)] of what all estimates have in common (b), and all
  // blocks together.
  std::vector<double> common;
  // Of the picture's mean, relative to its square.
  double common_variance() const;
};

class Developer {
 public:
  // picture_scale: factor from what the film holds to the picture; balance: of its colours.
  Developer(const Film& film, std::vector<LayerScales> layers, double picture_scale,
            const glm::dmat3& balance = glm::dmat3(1.0));
  Image picture() const;
  // The same bits, by the pool's threads.
  Image picture(WorkerPool& pool) const;
  // Empty image if the half has nothing yet.
  Image half(int which) const;
  // Variance of the picture per pixel and channel, from the difference of the halves; empty where
  // these or the sampler's error are not known.
  Image variance() const;
  std::vector<SplitImage> splits(SplitKind kind) const;
  ErrorEstimate error() const;
  const LayerScales& scales(int layer) const { return layers_[static_cast<size_t>(layer)]; }
  GroupBlocks group_blocks() const;

 private:
  template <typename Value>
  Image image(const Value& value) const;
  template <typename Value>
  void fill(Image& image, int begin, int end, const Value& value) const;
  dvec3 pixel(int p) const;
  dvec3 half_pixel(int p, int layer, int which) const;
  dvec3 variance_pixel(int p) const;
  using Blocks = std::vector<double>;
  void add_common(int layer, const std::vector<double>& pixels, Blocks& common) const;
  // Variance of a layer's part of the picture's mean that its groups do not show.
  double common_variance(int layer) const;
  void estimate_pixels(ErrorEstimate& estimate) const;
  void estimate_picture_mean(ErrorEstimate& estimate) const;

  const Film& film_;
  std::vector<LayerScales> layers_;
  std::vector<std::vector<uint8_t>> subset_of_;  // [layer][pixel]; empty: one subset
  double picture_scale_;
  glm::dmat3 to_picture_;  // of a colour that the film holds: the balance times the scale
};

}  // namespace pssmlt
