// The viewer whom FLIP models: what is seen of an image, and how two of them differ.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "app/metrics/flip_color.h"
#include "app/metrics/flip_kernels.h"
#include "core/render/worker_pool.h"

namespace pssmlt::flip {

// What is compared: colours after contrast sensitivity filtering, and strengths of features.
struct Appearance {
  Appearance(int w, int h) : l(w, h), a(w, h), b(w, h), edges(w, h), points(w, h) {}
  Plane l, a, b;  // Hunt-adjusted CIELAB
  Plane edges, points;
};

// For images of one size; keeps the memory for the next ones.
class Observer {
 public:
  Observer(int width, int height, double pixels_per_degree, WorkerPool& pool);
  // colours(y, row) fills a row with what is displayed.
  void look(const std::function<void(int y, std::span<Rgb> row)>& colours, Appearance& seen);
  // error(x, y) = max(error(x, y), FLIP).
  void raise(const Appearance& picture, const Appearance& reference, Plane& error) const;

 private:
  struct Scratch;
  void filter_along_row(std::span<const Rgb> row, int y, Scratch& scratch);
  void see_colours(int y, Scratch& scratch, Appearance& seen) const;
  void see_features(int y, Scratch& scratch, Appearance& seen) const;

  int width_, height_;
  WorkerPool& pool_;
  Detectors detectors_;
  GaussianTerm y_, cx_;
  std::vector<GaussianTerm> cz_;
  float largest_;  // distance of two colours, to the exponent
  // Filtered along rows.
  Plane y_rows_, cx_rows_;
  std::vector<Plane> cz_rows_;
  Plane smooth_rows_, edge_rows_, point_rows_;  // of relative luminance
};

}  // namespace pssmlt::flip
