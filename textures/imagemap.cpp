// An image, with pbrt-v4's parameters. The pixels are held in memory, as 8-bit values where the
// file has them, and shared by all textures of the same file. The filters trilinear and ewa follow
// the size of a pixel at the point's distance to the camera; point and bilinear use the full image.
#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "core/image/mipmap.h"
#include "core/plugin/plugin.h"
#include "core/texture.h"
#include "core/texture_mapping.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> filter_names = {"point", "bilinear", "trilinear", "ewa"};
constexpr std::array<std::string_view, 4> wrap_names = {"repeat", "black", "clamp",
                                                        "octahedralsphere"};

// What one axis does on its own.
enum class AxisWrap { as_both, repeat, clamp, mirror };
constexpr std::array<std::string_view, 4> axis_wrap_names = {"", "repeat", "clamp", "mirror"};
// Of files with colours, for textures of one number.
constexpr std::array<std::string_view, 5> channel_names = {"", "r", "g", "b", "a"};

template <size_t N>
size_t index_of(const std::array<std::string_view, N>& names, const std::string& name) {
  return static_cast<size_t>(std::ranges::find(names, name) - names.begin());
}

// One channel as an image of its own, 1 everywhere if the file has none of that name.
ImageFile only_channel(const ImageFile& file, const std::string& name) {
  ImageFile one{file.width, file.height, 1, {"Y"}, file.integer, {}, {}, {}};
  int from = file.find(name == "r" ? "R" : name == "g" ? "G" : name == "b" ? "B" : "A");
  if (from < 0 && name != "a" && file.channels <= 2) from = 0;  // grey
  const size_t count = static_cast<size_t>(file.width) * static_cast<size_t>(file.height);
  if (from < 0) {
    one.bytes.assign(count, 255);
    return one;
  }
  const auto first = static_cast<size_t>(from), step = static_cast<size_t>(file.channels);
  for (size_t i = first; i < file.bytes.size(); i += step) one.bytes.push_back(file.bytes[i]);
  for (size_t i = first; i < file.floats.size(); i += step) one.floats.push_back(file.floats[i]);
  return one;
}

template <typename T>
std::shared_ptr<const Mipmap<T>> load(const std::string& path, const std::string& encoding_name,
                                      bool pyramid, const std::string& channel) {
  using Key = std::tuple<std::string, std::string, bool, std::string>;
  static std::map<Key, std::weak_ptr<const Mipmap<T>>> loaded;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const Mipmap<T>>& entry = loaded[{path, encoding_name, pyramid, channel}];
  if (auto known = entry.lock()) return known;
  const ImageFile whole = read_image_file(path);
  const ImageFile file = channel.empty() ? whole : only_channel(whole, channel);
  const Encoding encoding =
      encoding_name.empty() ? Encoding::srgb() : Encoding::parse(encoding_name);
  auto made = std::make_shared<const Mipmap<T>>(file, encoding, pyramid);
  entry = made;
  return made;
}

template <typename T>
class ImageMap final : public Texture<T> {
 public:
  static constexpr const char* summary = "an image file";

  explicit ImageMap(Parameters& p)
      : mapping_(p),
        filter_(static_cast<TextureFilter>(
            index_of(filter_names,
                     p.choice("filter", "bilinear", filter_names,
                              "how pixels are averaged; point and bilinear ignore distance")))),
        wrap_(static_cast<TextureWrap>(
            index_of(wrap_names, p.choice("wrap", "repeat", wrap_names, "what lies outside")))),
        wraps_{read_axis_wrap(p, "uwrap"), read_axis_wrap(p, "vwrap")},
        most_anisotropy_(p.number("maxanisotropy", 8.f, "",
                                  "ewa: longest footprint kept sharp across, in its widths")),
        scale_(p.number("scale", 1.f, "", "factor")),
        invert_(p.flag("invert", false, "1 - value, after the factor")) {
    const std::string path = p.file("filename", "the image");
    const std::string encoding =
        p.text("encoding", "", "sRGB, linear or gamma N of integer files; default: sRGB");
    const std::string channel =
        p.choice("channel", "", channel_names,
                 "float textures: the channel taken; default: alpha if it varies, else the mean");
    if (!(most_anisotropy_ >= 1.f)) p.fail("maxanisotropy", "\"maxanisotropy\" must be at least 1");
    if (p.describing()) return;
    if (path.empty()) p.fail("filename is needed");
    try {
      if (!encoding.empty()) Encoding::parse(encoding);
    } catch (const Error& e) {
      p.fail("encoding", e.what());
    }
    try {
      image_ =
          load<T>(path, encoding, reads_derivatives(), std::is_same_v<T, float> ? channel : "");
    } catch (const Error& e) {
      p.fail("filename", e.what());
    }
  }

  T evaluate(const Hit& hit) const override {
    // The image's first row is at t = 1.
    vec2 st = mapping_.map(hit);
    st.y = 1.f - st.y;
    st.x = wrapped(st.x, image_->width(), wraps_[0]);
    st.y = wrapped(st.y, image_->height(), wraps_[1]);
    return adjusted(lookup(st, hit));
  }
  // For footprints, which choose among an image's sizes.
  bool reads_derivatives() const override {
    return filter_ == TextureFilter::trilinear || filter_ == TextureFilter::ewa;
  }

 private:
  static AxisWrap read_axis_wrap(Parameters& p, const char* name) {
    return static_cast<AxisWrap>(index_of(
        axis_wrap_names,
        p.choice(name, "", axis_wrap_names, "what lies outside along one axis; default: wrap")));
  }
  // Along one axis of an image that repeats: between the centres of the outer texels nothing
  // outside is asked for, and what is mirrored is symmetric about its edges.
  static float wrapped(float s, int size, AxisWrap wrap) {
    if (wrap == AxisWrap::as_both) return s;
    if (wrap == AxisWrap::repeat) return s - std::floor(s);
    if (wrap == AxisWrap::mirror) s = 1.f - std::abs(1.f - (s - 2.f * std::floor(0.5f * s)));
    const float half = 0.5f / static_cast<float>(size);
    return s < half ? half : s > 1.f - half ? 1.f - half : s;
  }
  T lookup(const vec2& st, const Hit& hit) const {
    if (filter_ == TextureFilter::bilinear) return image_->bilinear(st, wrap_);
    if (filter_ == TextureFilter::point) return image_->point(st, wrap_);
    TextureFootprint f = mapping_.footprint(hit);
    f.axis0.y = -f.axis0.y;
    f.axis1.y = -f.axis1.y;
    if (filter_ == TextureFilter::ewa)
      return image_->ewa(st, f.axis0, f.axis1, wrap_, most_anisotropy_);
    const vec2 widest = glm::max(glm::abs(f.axis0), glm::abs(f.axis1));
    return image_->trilinear(st, std::max(widest.x, widest.y), wrap_);
  }
  // Not negative if a colour or inverted, as pbrt-v4. NaN stays NaN.
  T adjusted(const T& value) const {
    const auto positive = [](float v) { return v < 0.f ? 0.f : v; };
    if constexpr (std::is_same_v<T, float>) {
      return invert_ ? positive(1.f - scale_ * value) : scale_ * value;
    } else {
      const Rgb c = invert_ ? 1.f - scale_ * value : scale_ * value;
      return {positive(c.x), positive(c.y), positive(c.z)};
    }
  }

  TextureMapping2D mapping_;
  TextureFilter filter_;
  TextureWrap wrap_;
  std::array<AxisWrap, 2> wraps_;
  float most_anisotropy_;
  float scale_;
  bool invert_;
  std::shared_ptr<const Mipmap<T>> image_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_TEXTURE_PLUGIN("imagemap", pssmlt::ImageMap)
