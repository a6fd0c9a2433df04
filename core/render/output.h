// Pictures out: layers of one EXR, and a place for the picture if the one asked for fails.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/image/image.h"

namespace pssmlt {

// The images as the channels of one: the first keeps its names (R, G, B), the others get theirs in
// front ("albedo.R"). Empty images are left out. All have the first one's size.
Image join_layers(const std::vector<std::pair<std::string, const Image*>>& layers);
// Writes the image; if that fails, to another place, which is said in the log. False if the file
// that was asked for could not be written; throws Failure if no place takes it.
bool write_or_rescue(const std::string& path, const Image& image, const ImageMetadata& metadata,
                     const DisplaySettings& display);
// "out.exr", "length2" -> "out.length2.exr".
std::string with_suffix(const std::string& path, const std::string& suffix);
// True if the file can hold layers (EXR).
bool holds_layers(const std::string& path);

}  // namespace pssmlt
