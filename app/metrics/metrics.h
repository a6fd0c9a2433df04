// How far a picture is from a reference: numbers for the whole picture and maps of pixels. The
// formulas and their sources are in docs/metrics.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"

namespace pssmlt {

struct Metric {
  std::string_view id, name, formula, unit_note;
};
// mse, relmse, relmse_trimmed, smape, flip. For all of them smaller is better and 0 is equality.
std::span<const Metric> metrics();
// Position in metrics(). Throws Error with a suggestion if there is no such metric.
size_t metric_index(const std::string& id);

struct Comparison {
  std::vector<double> values;  // in the order of metrics(); NaN: not asked for, or no pixel counts
  // Mean luminance of picture - reference over the reference's, and its standard error from the
  // spread of blocks of pixels (BlockGrid), whose errors are taken for independent. A factor common
  // to the whole picture (the b of Metropolis) is not in the error. NaN: a black reference, or
  // fewer than two blocks.
  double mean_bias = 0.0, mean_bias_error = 0.0;
  int64_t non_finite = 0;  // pixels that no number counts: a channel of either is NaN or infinite
};

// Colour images by their channels R, G, B, whatever else they hold; images of one or two channels
// are grey. ids: the metrics wanted, empty for all (flip costs a hundred times the others). The
// result does not depend on `threads` (0: one per logical processor). Throws Error where sizes
// differ or a layered image has no R, G, B.
Comparison compare_images(const Image& picture, const Image& reference,
                          std::span<const std::string> ids = {}, int threads = 0);

// One channel, "Y": the metric's value pixel by pixel. The mean of what is not NaN is the metric;
// NaN marks pixels left out. Throws Error as compare_images() and metric_index() do.
Image error_map(const std::string& id, const Image& picture, const Image& reference,
                int threads = 0);

}  // namespace pssmlt
