#include "app/metrics/picture_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"

namespace pssmlt {
namespace {

std::array<size_t, 3> colour_channels(const Image& image) {
  const auto& names = image.channel_names;
  std::array<size_t, 3> channels{};
  bool found = true;
  for (size_t c = 0; c < 3; ++c) {
    const auto at = std::ranges::find(names, std::string(1, "RGB"[c]));
    found = found && at != names.end();
    channels[c] = static_cast<size_t>(at - names.begin());
  }
  if (found) return channels;
  if (image.channels < 3) return {0, 0, 0};
  if (names.empty()) return {0, 1, 2};
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw Error("an image has no channels R, G and B; it has " + list);
}

std::vector<Rgb> colours(const Image& image) {
  const std::array<size_t, 3> at = colour_channels(image);
  const auto channels = static_cast<size_t>(image.channels);
  std::vector<Rgb> result(image.data.size() / channels);
  for (size_t i = 0; i < result.size(); ++i) {
    const float* const p = &image.data[i * channels];
    result[i] = {p[at[0]], p[at[1]], p[at[2]]};
  }
  return result;
}

}  // namespace

PicturePair::PicturePair(const Image& first, const Image& second)
    : width(second.width), height(second.height) {
  if (first.width != width || first.height != height) {
    throw Error(fmt::format("the images differ in size: {} x {} and {} x {} pixels", first.width,
                            first.height, width, height));
  }
  picture = colours(first);
  reference = colours(second);
  counts.resize(pixels());
  double sum = 0.0;
  for (size_t i = 0; i < pixels(); ++i) {
    counts[i] = is_finite(picture[i]) && is_finite(reference[i]);
    if (counts[i]) {
      sum += 0.2126 * double(reference[i].x) + 0.7152 * double(reference[i].y) +
             0.0722 * double(reference[i].z);
    } else {
      ++non_finite;
    }
  }
  const auto counted = static_cast<double>(static_cast<int64_t>(pixels()) - non_finite);
  if (counted > 0.0) reference_mean = sum / counted;
}

}  // namespace pssmlt
