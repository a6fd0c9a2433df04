// What an integrator returns for one point u: splats, i.e. raster positions with values.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/rgb.h"

namespace pssmlt {

// Which path a value came from, for images by path length and by strategy.
struct PathTag {
  uint32_t bounces = 0;   // scattering vertices
  uint16_t s = 0, t = 0;  // vertices on the light and camera subpaths (bidirectional strategies)
};

// Both kinds of splat have one scale: the picture is (pixels in the window / number of samples)
// times the sum. A camera splat is the radiance estimate at the sample's own raster position, a
// light splat carries importance as the camera normalises it (core/endpoint.h).
struct Splat {
  dvec2 raster{0.0};  // [pixels]; of camera splats: unused
  Rgb value{0.f};     // [W/(m^2 sr)]
  PathTag tag;
  bool from_camera = true;
  std::array<uint8_t, 3> unused{};  // stored chains have no undefined bytes
};
static_assert(sizeof(Splat) == sizeof(dvec2) + sizeof(Rgb) + sizeof(PathTag) + 4);
static_assert(sizeof(PathTag) == 8);

class Splats {
 public:
  Splats() { splats_.reserve(256); }
  void clear() { splats_.clear(); }
  // Keep values of different tags apart (images by length or strategy asked for)?
  void keep_tags(bool keep) { keep_tags_ = keep; }
  bool keeps_tags() const { return keep_tags_; }

  // Radiance estimate at the raster position of the camera subpath. Zero values are dropped.
  void camera(const Rgb& value, PathTag tag) {
    if (is_black(value)) return;
    if (!keep_tags_) {
      if (!splats_.empty() && splats_.front().from_camera) {
        splats_.front().value += value;
        return;
      }
      splats_.insert(splats_.begin(), Splat{dvec2(0.0), value, tag, true, {}});
      return;
    }
    splats_.push_back({dvec2(0.0), value, tag, true, {}});
  }
  // Value that lands at a raster position of its own [pixels].
  void light(const dvec2& raster, const Rgb& value, PathTag tag) {
    if (is_black(value)) return;
    splats_.push_back({raster, value, tag, false, {}});
  }

  const std::vector<Splat>& all() const { return splats_; }
  bool empty() const { return splats_.empty(); }
  void assign(const Splat* first, size_t count) { splats_.assign(first, first + count); }
  void scale(float factor) {
    for (Splat& s : splats_) s.value *= factor;
  }
  // Adds one splat as it is.
  void add(const Splat& splat) { splats_.push_back(splat); }

 private:
  std::vector<Splat> splats_;  // growth past the reserve is counted by the allocation test
  bool keep_tags_ = false;
};

// Sum of the luminances of all splats: the scalar target of Markov chains.
inline double luminance(const Splats& splats) {
  double sum = 0.0;
  for (const Splat& s : splats.all()) sum += luminance(s.value);
  return sum;
}

}  // namespace pssmlt
