#include "app/merge/merge_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace pssmlt {
namespace {

std::string channel_name(const Image& image, int channel) {
  const auto at = static_cast<size_t>(channel);
  return at < image.channel_names.size() ? image.channel_names[at]
                                         : std::string(1, "RGBA"[std::min<size_t>(at, 3)]);
}

int find_channel(const Image& image, const std::string& name) {
  for (int c = 0; c < image.channels; ++c) {
    if (channel_name(image, c) == name) return c;
  }
  return -1;
}

// "half0" of "half0.R", "" of "R".
std::string layer_of(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

// What is added up of a channel.
enum class Rule { average, variance, deviation };

Rule rule_of(const std::string& layer) {
  return layer == "variance" ? Rule::variance : layer == "error" ? Rule::deviation : Rule::average;
}

double term(Rule rule, double weight, double value) {
  switch (rule) {
    case Rule::variance:
      return weight * weight * value;
    case Rule::deviation:
      return weight * weight * value * value;
    case Rule::average:
      break;
  }
  return weight * value;
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

void check_sizes(std::span<const Image> images) {
  for (const Image& i : images) {
    if (i.width == images[0].width && i.height == images[0].height) continue;
    throw Error(fmt::format("the images differ in size: {} x {} and {} x {} pixels",
                            images[0].width, images[0].height, i.width, i.height));
  }
}

// The channel's position in every image; empty if one does not have it.
std::vector<int> positions(std::span<const Image> images, const std::string& name) {
  std::vector<int> result;
  for (const Image& image : images) {
    const int at = find_channel(image, name);
    if (at < 0) return {};
    result.push_back(at);
  }
  return result;
}

void merge_channel(std::span<const Image> images, std::span<const double> weights,
                   const std::vector<int>& from, Rule rule, int to, Image& merged) {
  for (int y = 0; y < merged.height; ++y) {
    for (int x = 0; x < merged.width; ++x) {
      double sum = 0.0;
      for (size_t i = 0; i < images.size(); ++i) {
        sum += term(rule, weights[i], static_cast<double>(images[i].pixel(x, y)[from[i]]));
      }
      merged.pixel(x, y)[to] = static_cast<float>(rule == Rule::deviation ? std::sqrt(sum) : sum);
    }
  }
}

}  // namespace

MergedImage merge_images(std::span<const Image> images, std::span<const double> weights,
                         bool independent) {
  check_sizes(images);
  MergedImage result;
  std::vector<std::pair<std::vector<int>, Rule>> channels;
  std::vector<std::string> names;
  for (const Image& image : images) {
    for (int c = 0; c < image.channels; ++c) {
      const std::string name = channel_name(image, c), layer = layer_of(name);
      if (std::ranges::find(names, name) != names.end()) continue;
      const Rule rule = rule_of(layer);
      std::vector<int> from = positions(images, name);
      if (from.empty() || (rule != Rule::average && !independent)) {
        add_once(result.left_out, layer.empty() ? name : layer);
        continue;
      }
      names.push_back(name);
      channels.emplace_back(std::move(from), rule);
    }
  }
  if (names.empty()) throw Error("the images have no channel in common");
  result.image = Image(images[0].width, images[0].height, static_cast<int>(names.size()));
  result.image.channel_names = std::move(names);
  for (size_t c = 0; c < channels.size(); ++c) {
    merge_channel(images, weights, channels[c].first, channels[c].second, static_cast<int>(c),
                  result.image);
  }
  return result;
}

}  // namespace pssmlt
