// The picture that errors are measured against: read from a file, or made by two techniques with
// independent random numbers, which are held against each other.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/agreement.h"
#include "app/compare/scene_job.h"
#include "core/render/render.h"

namespace pssmlt::compare {

struct Reference {
  Image image;
  Image half[2];                        // independent halves, empty if not known
  std::string source;                   // "file" or "made"
  std::string file;                     // where it was read from, or lies in the cache
  std::vector<std::string> techniques;  // that made it; their names
  double seconds = 0.0;                 // wall time of both
  Number mean_error;                    // relative standard error of its mean luminance
  std::optional<Agreement> agreement;
  std::vector<Number> floor;  // its own error, in the order of metrics(); unknown without halves
};

// True for metrics that are means of squares: errors of independent pictures add up.
bool is_squared(std::string_view metric);

// A picture's own error from its halves. Squares: the metric of half the halves' difference, whose
// square has the picture's variance for its expectation. Others (they grow like a difference): the
// metric between the halves, over 2.
std::vector<Number> own_error(const Image& picture, const Image& half0, const Image& half1);

// A picture's R, G, B (a grey one thrice); `layer`: "", or as in "half0.R". Empty if it has none.
Image rgb_layer(const Image& image, const std::string& layer);

// Throws Error if it cannot be read or has another size. Halves are taken from an EXR that has them
// (pssmlt render --aux halves).
Reference read_reference(const std::string& file, const ivec2& size);

// Two techniques' pictures, combined. Weights are constant over the picture, inverse to the
// estimated relative variances, so that they do not follow the noise. If the two do not agree
// nothing is averaged: the brighter one is taken, since techniques miss light rather than invent
// it.
struct Half {  // one technique's share
  std::string name;
  RenderResult result;
  GroupBlocks blocks;
};
Reference combine(const Half& a, const Half& b);

}  // namespace pssmlt::compare
