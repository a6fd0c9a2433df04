#include "app/compare/reference.h"

#include <algorithm>
#include <cmath>

#include "app/metrics/metrics.h"
#include "core/base/math.h"
#include "core/render/relative_denominators.h"

namespace pssmlt::compare {
namespace {

// wa * a + wb * b; empty if either is.
Image mix(const Image& a, double wa, const Image& b, double wb) {
  if (a.data.empty() || b.data.empty()) return {};
  Image sum = a;
  for (size_t i = 0; i < sum.data.size(); ++i) {
    sum.data[i] = static_cast<float>(wa * static_cast<double>(a.data[i]) +
                                     wb * static_cast<double>(b.data[i]));
  }
  return sum;
}

double mean(const Image& image) {
  double sum = 0.0;
  for (const float v : image.data) sum += static_cast<double>(v);
  return image.data.empty() ? 0.0 : sum / static_cast<double>(image.data.size());
}

// What variances are divided by to be relative: the same for both techniques, since each one's own
// noise would flatter it. Of both pictures' mean.
struct Level {
  Image picture;
  std::vector<double> denominators;
};
Level common_level(const RenderResult& a, const RenderResult& b) {
  Level level{mix(a.image, 0.5, b.image, 0.5), {}};
  const Image half[2] = {mix(a.half[0], 0.5, b.half[0], 0.5), mix(a.half[1], 0.5, b.half[1], 0.5)};
  if (half[0].data.empty() || half[1].data.empty()) return level;
  const double epsilon = relative_mse_epsilon * sqr(mean(level.picture));
  level.denominators = relative_denominators(level.picture, half[0], half[1], epsilon);
  return level;
}

// Relative variance of a technique's picture, b's included. nullopt: too few rounds to tell.
Number relative_variance(const Half& h, const Level& level) {
  const Image& variance = h.result.variance;
  if (variance.data.empty() || level.denominators.empty()) return std::nullopt;
  const double common = h.blocks.common_variance();
  double sum = 0.0;
  for (size_t i = 0; i < variance.data.size(); ++i) {
    if (!(level.denominators[i] > 0.0)) continue;
    // As in the renderer's own estimate, a spike's square is not what the light is likely to be.
    const double square =
        std::min(level.denominators[i], sqr(static_cast<double>(level.picture.data[i])));
    sum += (static_cast<double>(variance.data[i]) + common * square) / level.denominators[i];
  }
  return sum;
}

// Weight of the first.
double weight_of_first(const Half& a, const Half& b) {
  const bool a_black = mean(a.result.image) == 0.0, b_black = mean(b.result.image) == 0.0;
  if (a_black != b_black) return a_black ? 0.0 : 1.0;
  const Level level = common_level(a.result, b.result);
  const Number va = relative_variance(a, level), vb = relative_variance(b, level);
  if (!va || !vb || !(*va + *vb > 0.0)) return 0.5;
  return *vb / (*va + *vb);
}

Number relative_mean_error(const ErrorEstimate& e) {
  if (!e.mean_known || !(e.mean > 0.0)) return std::nullopt;
  return e.mean_error / e.mean;
}

}  // namespace

bool is_squared(std::string_view metric) { return metric.find("mse") != std::string_view::npos; }

std::vector<Number> own_error(const Image& picture, const Image& half0, const Image& half1) {
  const auto all = metrics();
  std::vector<Number> errors(all.size());
  if (half0.data.empty() || half1.data.empty()) return errors;
  const Image deviation = mix(half0, 0.5, half1, -0.5);
  const Comparison squares = compare_images(mix(picture, 1.0, deviation, 1.0), picture);
  const Comparison between = compare_images(half0, half1);
  for (size_t m = 0; m < all.size(); ++m) {
    errors[m] = is_squared(all[m].id) ? squares.values[m] : 0.5 * between.values[m];
  }
  return errors;
}

Image rgb_layer(const Image& image, const std::string& layer) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  const auto channel = [&](const char* name) {
    const auto at = std::ranges::find(image.channel_names, prefix + name);
    return at == image.channel_names.end() ? -1
                                           : static_cast<int>(at - image.channel_names.begin());
  };
  std::array<int, 3> from = {channel("R"), channel("G"), channel("B")};
  if (*std::ranges::min_element(from) < 0) {
    if (!layer.empty() || image.channels < 1) return {};
    from = image.channels < 3 ? std::array{0, 0, 0} : std::array{0, 1, 2};
  }
  Image rgb(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (size_t c = 0; c < 3; ++c) rgb.pixel(x, y)[c] = image.pixel(x, y)[from[c]];
    }
  }
  return rgb;
}

Reference read_reference(const std::string& file, const ivec2& size) {
  const Image stored = read_image(file, "");
  if (stored.width != size.x || stored.height != size.y) {
    throw Error("the reference \"" + file + "\" has " + std::to_string(stored.width) + " x " +
                std::to_string(stored.height) + " pixels, the picture " + std::to_string(size.x) +
                " x " + std::to_string(size.y));
  }
  Reference r;
  r.image = rgb_layer(stored, "");
  for (const float v : r.image.data) {
    if (!std::isfinite(v))
      throw Error("the reference \"" + file + "\" has pixels that are not finite");
  }
  r.half[0] = rgb_layer(stored, "half0");
  r.half[1] = rgb_layer(stored, "half1");
  r.source = "file";
  r.file = file;
  r.floor = own_error(r.image, r.half[0], r.half[1]);
  return r;
}

Reference combine(const Half& a, const Half& b) {
  Reference r;
  r.source = "made";
  r.techniques = {a.name, b.name};
  r.seconds = a.result.seconds + b.result.seconds;
  r.agreement = test_agreement(a.blocks, b.blocks, a.name, b.name);
  double weight = weight_of_first(a, b);
  if (r.agreement->biased) {
    weight = mean(a.result.image) >= mean(b.result.image) ? 1.0 : 0.0;
    r.agreement->text +=
        "; the reference is the brighter one alone: " + (weight > 0.0 ? a.name : b.name);
  }
  r.image = mix(a.result.image, weight, b.result.image, 1.0 - weight);
  for (int h = 0; h < 2; ++h) {
    r.half[h] = mix(a.result.half[h], weight, b.result.half[h], 1.0 - weight);
  }
  const Number ea = relative_mean_error(a.result.error), eb = relative_mean_error(b.result.error);
  if (weight == 0.0) {
    r.mean_error = eb;
  } else if (weight == 1.0) {
    r.mean_error = ea;
  } else if (ea && eb) {
    r.mean_error = std::hypot(weight * *ea, (1.0 - weight) * *eb);
  }
  r.floor = own_error(r.image, r.half[0], r.half[1]);
  return r;
}

}  // namespace pssmlt::compare
