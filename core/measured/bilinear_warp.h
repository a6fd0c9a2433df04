// Densities over the unit square, bilinear between the nodes of a grid, and the maps by which they
// are sampled and undone (Dupuy and Jakob 2018, section 4.2: data-driven parameterisations).
// Several grids, given at the nodes of up to two outer parameters, are blended linearly: what is
// sampled is exactly the blend of their densities.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/math.h"

namespace pssmlt {

// Which of the grids a value is blended from; the weights sum to one.
struct GridBlend {
  std::array<uint32_t, 4> grid{};
  std::array<float, 4> weight{};
};

// Nodes of the outer parameters, ascending; grid (i, j) has number i * second.size() + j. Beyond
// the ends the end's grid counts.
class GridAxes {
 public:
  GridAxes() = default;
  GridAxes(std::vector<float> first, std::vector<float> second)
      : first_(std::move(first)), second_(std::move(second)) {}
  GridBlend at(float a, float b) const;
  size_t count() const { return first_.size() * second_.size(); }
  const std::vector<float>& first() const { return first_; }
  const std::vector<float>& second() const { return second_; }

 private:
  std::vector<float> first_{0.f}, second_{0.f};
};

// A point of [0,1]^2 in a grid of nodes: the lower corner of its cell, and where in the cell.
struct GridCell {
  int x = 0, y = 0;
  float fx = 0.f, fy = 0.f;
};
GridCell grid_cell(const vec2& point, int width, int height);

class BilinearWarp {
 public:
  BilinearWarp() = default;
  // Grids of width x height nodes (two or more each way), rows of x one after the other; finite and
  // not negative. Each is scaled to integrate to 1; one of zeros alone counts as uniform.
  BilinearWarp(std::vector<float> values, int width, int height);

  // [1], with respect to the unit square.
  float density(const GridBlend& blend, const vec2& point) const;
  struct Mapped {
    vec2 point{0.f};
    float density = 0.f;  // of sample(): at its point for sample(), at its argument for invert()
  };
  Mapped sample(const GridBlend& blend, const vec2& u) const;
  // The u that sample() takes to the point.
  Mapped invert(const GridBlend& blend, const vec2& point) const;

 private:
  // Blended: a node's density, the integral along a row up to a node, the integral of whole rows up
  // to a row.
  float node(const GridBlend& b, int x, int y) const {
    return blended(b, values_, size_t(width_), x, y);
  }
  float along(const GridBlend& b, int x, int y) const {
    return blended(b, along_, size_t(width_), x, y);
  }
  float below(const GridBlend& b, int y) const { return blended(b, below_, 1, 0, y); }
  float row(const GridBlend& b, int y) const { return along(b, width_ - 1, y); }
  float blended(const GridBlend& b, const std::vector<float>& table, size_t stride, int x,
                int y) const;
  void normalise(size_t grid);
  void accumulate(size_t grid);

  int width_ = 0, height_ = 0;
  std::vector<float> values_, along_, below_;
};

}  // namespace pssmlt
