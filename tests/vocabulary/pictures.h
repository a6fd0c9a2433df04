// Independent renders of a small scene, and whether two settings show the same beyond their noise.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace pssmlt::test {

// Renders of one scene with different seeds.
struct Pictures {
  std::vector<Image> images;
  std::string record;  // what the film asks to be written, and where
};

inline constexpr int pictures_rendered = 32;

// `folder` has the files that the text names. Of film "gbuffer" its layers are channels of the
// images, too. Throws Error.
Pictures render_pictures(const std::string& text, const std::filesystem::path& folder);

struct Difference {
  bool bits = false;     // any number of any picture differs
  bool picture = false;  // beyond noise: in size, or in the mean of a block
  double excess = 0.0;   // of the clearest block, in limits; 0 if nothing can be compared
};

// Welch's test of every channel of every block of 1, 4 x 4 and all pixels. If the settings'
// pictures have the same means, and differ in their noise only, `picture` is true with a
// probability below 1e-6 (of one call): each block has its share of that, Student's t with the
// fewer degrees of freedom that Welch's may have. Blocks that do not vary from seed to seed differ
// if they do by a ten-thousandth, which rounding does not make.
Difference compare(const Pictures& a, const Pictures& b);

}  // namespace pssmlt::test
