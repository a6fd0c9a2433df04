// compare_images IMAGE REFERENCE [TRIM]: how far two pictures of one size are apart, as one line of
// JSON. Luminances are compared; errors are relative to the reference:
//   mean           signed, of the mean over the picture
//   block_median   median over blocks of 16 x 16 pixels (cut at the right and lower edge)
//   block_p95      95 % quantile over the blocks
//   relmse         mean over the pixels of (a - b)^2 / (b^2 + 0.01 mean(b)^2)
// A block's error is |a - b| / max(b, 1 % of the picture's mean), so that black blocks do not
// divide by zero. TRIM (0.01: the worst 1 %) leaves out that share of the pixels, those where the
// two differ most, against fireflies of a reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"

namespace {
using namespace pssmlt;

constexpr int edge = 16;

struct Luminances {
  int width = 0, height = 0;
  std::vector<double> values;
};

int channel(const Image& image, const char* name, int fallback) {
  const auto found = std::ranges::find(image.channel_names, name);
  return found == image.channel_names.end() ? fallback
                                            : static_cast<int>(found - image.channel_names.begin());
}

Luminances read_luminances(const std::string& path) {
  const Image image = read_image(path, "linear");
  if (image.channels < 3) throw Error(path + " is not a colour image");
  const int r = channel(image, "R", 0), g = channel(image, "G", 1), b = channel(image, "B", 2);
  Luminances l{image.width, image.height, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const p = image.pixel(x, y);
      l.values.push_back(static_cast<double>(luminance(Rgb(p[r], p[g], p[b]))));
    }
  }
  return l;
}

// Which pixels count: all but the given share with the largest difference.
std::vector<char> kept_pixels(const Luminances& a, const Luminances& b, double trim) {
  std::vector<size_t> order(a.values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, std::greater{},
                    [&](size_t i) { return std::abs(a.values[i] - b.values[i]); });
  std::vector<char> kept(order.size(), 1);
  const auto out = static_cast<size_t>(trim * static_cast<double>(order.size()));
  for (size_t i = 0; i < out; ++i) kept[order[i]] = 0;
  return kept;
}

struct Sums {
  double a = 0.0, b = 0.0, count = 0.0;
};

std::vector<Sums> block_sums(const Luminances& a, const Luminances& b,
                             const std::vector<char>& kept) {
  const int across = (a.width + edge - 1) / edge, down = (a.height + edge - 1) / edge;
  std::vector<Sums> blocks(static_cast<size_t>(across) * static_cast<size_t>(down));
  for (size_t i = 0; i < a.values.size(); ++i) {
    if (!kept[i]) continue;
    const int x = static_cast<int>(i) % a.width, y = static_cast<int>(i) / a.width;
    Sums& s = blocks[static_cast<size_t>(y / edge * across + x / edge)];
    s.a += a.values[i];
    s.b += b.values[i];
    s.count += 1.0;
  }
  std::erase_if(blocks, [](const Sums& s) { return s.count == 0.0; });
  return blocks;
}

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<size_t>(at);
  const size_t high = std::min(low + 1, values.size() - 1);
  return std::lerp(values[low], values[high], at - static_cast<double>(low));
}

double relative_mse(const Luminances& a, const Luminances& b, const std::vector<char>& kept) {
  double mean = 0.0, sum = 0.0, count = 0.0;
  for (const double value : b.values) mean += value / static_cast<double>(b.values.size());
  for (size_t i = 0; i < a.values.size(); ++i) {
    if (!kept[i]) continue;
    const double d = a.values[i] - b.values[i], r = b.values[i];
    sum += d * d / std::max(r * r + 0.01 * mean * mean, 1e-300);
    count += 1.0;
  }
  return sum / count;
}

void compare(const std::string& image, const std::string& reference, double trim) {
  const Luminances a = read_luminances(image), b = read_luminances(reference);
  if (a.width != b.width || a.height != b.height) {
    throw Error(fmt::format("{} has {}x{} pixels, {} has {}x{}", image, a.width, a.height,
                            reference, b.width, b.height));
  }
  const std::vector<char> kept = kept_pixels(a, b, trim);
  const std::vector<Sums> blocks = block_sums(a, b, kept);
  Sums all;
  for (const Sums& s : blocks) all = {all.a + s.a, all.b + s.b, all.count + s.count};
  const double floor = 0.01 * all.b / all.count;
  std::vector<double> errors;
  for (const Sums& s : blocks) {
    const double x = s.a / s.count, y = s.b / s.count;
    errors.push_back(std::abs(x - y) / std::max({y, floor, 1e-300}));
  }
  fmt::print(
      "{{\"mean\": {:.6g}, \"block_median\": {:.6g}, \"block_p95\": {:.6g}, "
      "\"blocks\": {}, \"relmse\": {:.6g}}}\n",
      all.b > 0.0 ? all.a / all.b - 1.0 : all.a, quantile(errors, 0.5), quantile(errors, 0.95),
      blocks.size(), relative_mse(a, b, kept));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    fmt::print(stderr, "usage: compare_images IMAGE REFERENCE [TRIM]\n");
    return 2;
  }
  try {
    compare(argv[1], argv[2], argc == 4 ? std::strtod(argv[3], nullptr) : 0.0);
  } catch (const std::exception& e) {
    fmt::print(stderr, "compare_images: {}\n", e.what());
    return 2;
  }
  return 0;
}
