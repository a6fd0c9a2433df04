#include "tests/vocabulary/pictures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/defaults.h"
#include "core/render/auxiliary.h"
#include "core/render/output.h"
#include "core/render/render.h"
#include "core/scene/parser.h"
#include "tests/support/student.h"

namespace pssmlt::test {
namespace {

constexpr double false_alarm = 1e-6;  // of one comparison
constexpr double rounding = 1e-4;     // relative

Image with_layers_of(const BuiltScene& scene, const RenderResult& result, uint64_t seed) {
  if (scene.film_layers.empty()) return result.image;
  const AuxiliaryImages seen = render_auxiliary(scene, seed, 1);
  return join_layers({{"", &result.image},
                      {"albedo", &seen.albedo},
                      {"normal", &seen.normal},
                      {"depth", &seen.depth}});
}

// Means over blocks of edge x edge pixels of one channel.
std::vector<double> block_means(const Image& image, int channel, int edge) {
  const int across = (image.width + edge - 1) / edge, down = (image.height + edge - 1) / edge;
  std::vector<double> sums(static_cast<size_t>(across * down)), counts(sums.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto block = static_cast<size_t>(y / edge * across + x / edge);
      sums[block] += static_cast<double>(image.pixel(x, y)[channel]);
      counts[block] += 1.0;
    }
  }
  for (size_t b = 0; b < sums.size(); ++b) sums[b] /= counts[b];
  return sums;
}

// Of every block by all renders: [block].
std::vector<Estimate> estimates(const Pictures& pictures) {
  const Image& first = pictures.images.front();
  std::vector<Estimate> all;
  for (const int edge : {1, 4, std::max(first.width, first.height)}) {
    for (int channel = 0; channel < first.channels; ++channel) {
      std::vector<std::vector<double>> values;  // [render][block]
      for (const Image& image : pictures.images)
        values.push_back(block_means(image, channel, edge));
      for (size_t b = 0; b < values.front().size(); ++b) {
        std::vector<double> block;
        for (const std::vector<double>& render : values) block.push_back(render[b]);
        all.push_back(estimate(block));
      }
    }
  }
  return all;
}

// |t| that no block of so many may exceed; there are few different numbers of them.
double limit_of(size_t blocks) {
  static std::map<size_t, double> known;
  const auto [at, fresh] = known.try_emplace(blocks, 0.0);
  if (fresh)
    at->second = student_limit(false_alarm / static_cast<double>(blocks), pictures_rendered - 1);
  return at->second;
}

bool same_size(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

}  // namespace

Pictures render_pictures(const std::string& text, const std::filesystem::path& folder) {
  BuildOptions options;
  options.defaults = default_plugins();
  options.honour_clamp = true;  // or "maxcomponentvalue" would do nothing
  const BuiltScene scene = build_scene(parse_string(text, "scene", folder.string()), options);
  Pictures pictures;
  pictures.record = scene.output;
  for (const std::string& layer : scene.film_layers) pictures.record += " " + layer;
  RenderSettings settings;
  settings.threads = 1;
  for (int r = 0; r < pictures_rendered; ++r) {
    // Far from the small seeds that scenes give.
    settings.seed = static_cast<uint64_t>(r) * 1000 + scene.seed.value_or(0);
    pictures.images.push_back(with_layers_of(scene, render(scene, settings), settings.seed));
  }
  return pictures;
}

Difference compare(const Pictures& a, const Pictures& b) {
  Difference found;
  if (!same_size(a.images.front(), b.images.front())) return {.bits = true, .picture = true};
  for (size_t r = 0; r < a.images.size(); ++r) found.bits |= a.images[r].data != b.images[r].data;
  if (!found.bits) return found;
  const std::vector<Estimate> x = estimates(a), y = estimates(b);
  const double limit = limit_of(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    const double apart = std::abs(x[i].mean - y[i].mean);
    const double error = std::sqrt(x[i].variance + y[i].variance);
    const double size = std::max(std::abs(x[i].mean), std::abs(y[i].mean));
    const double allowed = limit * error + rounding * size;
    if (apart > 0.0) found.excess = std::max(found.excess, apart / allowed);
  }
  found.picture = found.excess > 1.0;
  return found;
}

}  // namespace pssmlt::test
