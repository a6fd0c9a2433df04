// An image as a texture: filtered lookups in its pixels and, for wide footprints, in smaller
// copies.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/rgb.h"
#include "core/image/encoding.h"
#include "core/image/image_file.h"
#include "core/image/texel_store.h"

namespace pssmlt {

enum class TextureFilter { point, bilinear, trilinear, ewa };
// What lies outside [0, 1]^2; octahedral_sphere: the image is an equal-area map of the sphere,
// which continues across its edges turned by half a turn (core/base/equal_area.h).
enum class TextureWrap { repeat, black, clamp, octahedral_sphere };

// T is float or Rgb. 8-bit images stay 8-bit in memory, each texel is decoded when it is read, so
// that filters average linear values. Coordinates: (0, 0) is the corner of the image's upper row.
// Lookups of NaN or infinite coordinates are NaN.
template <typename T>
class Mipmap {
 public:
  // float: the only channel, the alpha channel if it is not 1 everywhere, or the mean of the others
  // (pbrt-v4). Rgb: R, G, B or the only channel; alpha is left out. The smaller copies are made if
  // `pyramid`. Throws Error if the image has two colour channels.
  Mipmap(const ImageFile& file, const Encoding& encoding, bool pyramid);

  T point(const vec2& st, TextureWrap wrap) const;
  T bilinear(const vec2& st, TextureWrap wrap) const { return bilinear(0, st, wrap); }
  // Between the two levels whose texels are about `width` [1, of the image's side] wide.
  T trilinear(const vec2& st, float width, TextureWrap wrap) const;
  // Weighted mean over the ellipse with half axes d0 / 2 and d1 / 2 around st (Heckbert 1989,
  // Fundamentals of Texture Mapping). Ellipses more than `most_anisotropy` times as long as wide
  // are widened: the cost of a lookup is bounded, at the price of some blur.
  T ewa(const vec2& st, vec2 d0, vec2 d1, TextureWrap wrap, float most_anisotropy) const;

  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }
  int levels() const { return static_cast<int>(levels_.size()); }
  // Memory of the pixels [bytes].
  size_t bytes() const;

 private:
  struct Level {
    int width = 0, height = 0;
    Texels<uint8_t> bytes;  // exactly one of the two is filled
    Texels<float> floats;
  };
  // A coordinate in texels and the two whose centres are around it, -1 for black ones; not wrapped
  // yet if both coordinates are needed for that.
  struct Axis {
    int low = 0, high = 0;
    float fraction = 0.f;
  };
  void load(const ImageFile& file, const Encoding& encoding);
  void load_mean(const ImageFile& file, const Encoding& encoding);
  void select(const ImageFile& file, const std::vector<int>& from);
  void build_pyramid(const Encoding& encoding);
  Level half(const Level& level, const Encoding& encoding) const;
  static Axis axis(float s, int size, TextureWrap wrap);
  static int wrapped(int i, int size, TextureWrap wrap);
  T texel(const Level& level, int x, int y) const;
  // The texel where Axis says, wrapped.
  T at(const Level& level, int x, int y, TextureWrap wrap) const;
  T bilinear(size_t level, const vec2& st, TextureWrap wrap) const;
  T ellipse(size_t level, const vec2& st, const vec2& d0, const vec2& d1, TextureWrap wrap) const;
  // The level whose texels are `width` wide, in [0, levels - 1].
  float level_of(float width) const;

  int channels_ = 1;
  std::vector<Level> levels_;
  std::array<float, 256> decoded_{};
};

extern template class Mipmap<float>;
extern template class Mipmap<Rgb>;

}  // namespace pssmlt
