#include "core/image/mipmap.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace pssmlt {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

bool has_transparency(const ImageFile& file, int alpha) {
  const auto step = static_cast<size_t>(file.channels);
  const auto first = static_cast<size_t>(alpha);
  for (size_t i = first; i < file.bytes.size(); i += step)
    if (file.bytes[i] != 255) return true;
  for (size_t i = first; i < file.floats.size(); i += step)
    if (file.floats[i] != 1.f) return true;
  return false;
}

// Indices of R, G, B or of the only colour channel.
std::vector<int> colour_channels(const ImageFile& file) {
  const std::vector<int> named = {file.find("R"), file.find("G"), file.find("B")};
  if (std::ranges::find(named, -1) == named.end()) return named;
  const int alpha = file.find("A");
  std::vector<int> others;
  for (int c = 0; c < file.channels; ++c)
    if (c != alpha) others.push_back(c);
  if (others.size() == 2) throw Error("an image of two colour channels can't be a texture");
  if (others.size() > 3) others.resize(3);
  if (others.empty()) others.push_back(alpha);
  return others;
}

float decoded_value(const ImageFile& file, size_t at, const Encoding& encoding) {
  if (!file.bytes.empty()) return encoding.to_linear(static_cast<float>(file.bytes[at]) / 255.f);
  return file.integer ? encoding.to_linear(file.floats[at]) : file.floats[at];
}

// The coordinate near the image that stands for s: no finite one overflows an integer.
float reduced(float s, TextureWrap wrap) {
  if (wrap == TextureWrap::repeat) return s - std::floor(s);
  if (wrap == TextureWrap::octahedral_sphere) return s - 2.f * std::floor(0.5f * s);
  return std::clamp(s, -2.f, 3.f);
}

// How often n goes into i, rounded down.
int floor_quotient(int i, int n) { return i >= 0 ? i / n : -((n - 1 - i) / n); }

}  // namespace

template <typename T>
Mipmap<T>::Mipmap(const ImageFile& file, const Encoding& encoding, bool pyramid) {
  load(file, encoding);
  if (pyramid) build_pyramid(encoding);
}

template <typename T>
void Mipmap<T>::load(const ImageFile& file, const Encoding& encoding) {
  std::vector<int> from = colour_channels(file);
  bool is_alpha = false;
  if constexpr (std::is_same_v<T, float>) {
    const int alpha = file.find("A");
    is_alpha = alpha >= 0 && has_transparency(file, alpha);
    if (is_alpha) from = {alpha};
    if (from.size() == 3) return load_mean(file, encoding);
  }
  const Encoding used = is_alpha ? Encoding::linear() : encoding;
  for (size_t i = 0; i < 256; ++i) decoded_[i] = used.to_linear(static_cast<float>(i) / 255.f);
  select(file, from);
  if (!file.integer) return;
  for (float& v : levels_[0].floats) v = used.to_linear(v);
}

// Copies the channels `from` as they are stored.
template <typename T>
void Mipmap<T>::select(const ImageFile& file, const std::vector<int>& from) {
  channels_ = static_cast<int>(from.size());
  Level level{file.width, file.height, {}, {}};
  const auto step = static_cast<size_t>(file.channels);
  const auto copy = [&](const auto& source, auto& target) {
    target.reserve(source.size() / step * from.size());
    for (size_t i = 0; i < source.size(); i += step)
      for (const int c : from) target.push_back(source[i + static_cast<size_t>(c)]);
  };
  copy(file.bytes, level.bytes);
  copy(file.floats, level.floats);
  levels_.push_back(std::move(level));
}

template <typename T>
void Mipmap<T>::load_mean(const ImageFile& file, const Encoding& encoding) {
  const std::vector<int> from = colour_channels(file);
  Level level{file.width, file.height, {}, {}};
  const auto step = static_cast<size_t>(file.channels);
  const size_t count = static_cast<size_t>(file.width) * static_cast<size_t>(file.height);
  level.floats.resize(count);
  for (size_t i = 0; i < count; ++i) {
    float sum = 0.f;
    for (const int c : from)
      sum += decoded_value(file, i * step + static_cast<size_t>(c), encoding);
    level.floats[i] = sum / static_cast<float>(from.size());
  }
  channels_ = 1;
  levels_.push_back(std::move(level));
}

template <typename T>
void Mipmap<T>::build_pyramid(const Encoding& encoding) {
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(half(levels_.back(), encoding));
}

// Half the size, rounded up; each texel is the mean over its own area, so that odd sizes keep the
// image's mean.
template <typename T>
typename Mipmap<T>::Level Mipmap<T>::half(const Level& level, const Encoding& encoding) const {
  Level result{(level.width + 1) / 2, (level.height + 1) / 2, {}, {}};
  const auto channels = static_cast<size_t>(channels_);
  const auto value = [&](int x, int y, size_t c) {
    const size_t at =
        (static_cast<size_t>(y) * static_cast<size_t>(level.width) + static_cast<size_t>(x)) *
            channels +
        c;
    return level.bytes.empty() ? level.floats[at] : decoded_[level.bytes[at]];
  };
  // Overlap of each source texel with a target texel, along one axis.
  struct Span {
    int first, last;
    float from, to;
  };
  const auto span = [](int i, int size, int source) {
    const float ratio = static_cast<float>(source) / static_cast<float>(size);
    const float from = static_cast<float>(i) * ratio, to = static_cast<float>(i + 1) * ratio;
    return Span{static_cast<int>(from), std::min(static_cast<int>(std::ceil(to)), source), from,
                to};
  };
  const auto overlap = [](const Span& s, int i) {
    const auto low = static_cast<float>(i);
    return std::max(0.f, std::min(s.to, low + 1.f) - std::max(s.from, low));
  };
  const bool is_linear_table = decoded_[128] == 128.f / 255.f;
  const size_t count = static_cast<size_t>(result.width) * static_cast<size_t>(result.height);
  if (level.bytes.empty()) {
    result.floats.reserve(count * channels);
  } else {
    result.bytes.reserve(count * channels);
  }
  const auto store = [&](float v) {
    if (level.bytes.empty()) return result.floats.push_back(v);
    const float stored = is_linear_table ? v : encoding.from_linear(v);
    result.bytes.push_back(static_cast<uint8_t>(std::clamp(stored, 0.f, 1.f) * 255.f + 0.5f));
  };
  for (int y = 0; y < result.height; ++y) {
    const Span rows = span(y, result.height, level.height);
    for (int x = 0; x < result.width; ++x) {
      const Span columns = span(x, result.width, level.width);
      const float area = (rows.to - rows.from) * (columns.to - columns.from);
      for (size_t c = 0; c < channels; ++c) {
        float sum = 0.f;
        for (int j = rows.first; j < rows.last; ++j)
          for (int i = columns.first; i < columns.last; ++i)
            sum += value(i, j, c) * overlap(rows, j) * overlap(columns, i);
        store(sum / area);
      }
    }
  }
  return result;
}

template <typename T>
size_t Mipmap<T>::bytes() const {
  size_t sum = 0;
  for (const Level& level : levels_)
    sum += level.bytes.size() + level.floats.size() * sizeof(float);
  return sum;
}

template <typename T>
int Mipmap<T>::wrapped(int i, int size, TextureWrap wrap) {
  if ((i >= 0 && i < size) || wrap == TextureWrap::octahedral_sphere) return i;
  if (wrap == TextureWrap::black) return -1;
  if (wrap == TextureWrap::clamp) return i < 0 ? 0 : size - 1;
  const int rest = i % size;
  return rest < 0 ? rest + size : rest;
}

template <typename T>
typename Mipmap<T>::Axis Mipmap<T>::axis(float s, int size, TextureWrap wrap) {
  const float x = reduced(s, wrap) * static_cast<float>(size) - 0.5f;
  const float low = std::floor(x);
  const int i = static_cast<int>(low);
  return {wrapped(i, size, wrap), wrapped(i + 1, size, wrap), x - low};
}

template <typename T>
T Mipmap<T>::texel(const Level& level, int x, int y) const {
  if ((x | y) < 0) return T(0.f);
  const size_t at =
      static_cast<size_t>(y) * static_cast<size_t>(level.width) + static_cast<size_t>(x);
  const auto read = [channels = channels_](const auto* pixels, size_t i, const auto& decode) {
    (void)channels;
    if constexpr (std::is_same_v<T, float>) {
      return decode(pixels[i]);
    } else {
      if (channels == 1) return Rgb(decode(pixels[i]));
      const auto* const p = pixels + 3 * i;
      return Rgb(decode(p[0]), decode(p[1]), decode(p[2]));
    }
  };
  if (level.bytes.empty()) return read(level.floats.data(), at, [](float v) { return v; });
  return read(level.bytes.data(), at, [this](uint8_t v) { return decoded_[v]; });
}

template <typename T>
T Mipmap<T>::at(const Level& level, int x, int y, TextureWrap wrap) const {
  if (wrap != TextureWrap::octahedral_sphere) return texel(level, x, y);
  const int across = floor_quotient(x, level.width), down = floor_quotient(y, level.height);
  x -= across * level.width;
  y -= down * level.height;
  if (((across + down) & 1) == 0) return texel(level, x, y);
  return texel(level, level.width - 1 - x, level.height - 1 - y);
}

template <typename T>
T Mipmap<T>::point(const vec2& st, TextureWrap wrap) const {
  if (!std::isfinite(st.x) || !std::isfinite(st.y)) return T(nan);
  const Level& level = levels_[0];
  const Axis x = axis(st.x, level.width, wrap), y = axis(st.y, level.height, wrap);
  return at(level, x.fraction < 0.5f ? x.low : x.high, y.fraction < 0.5f ? y.low : y.high, wrap);
}

template <typename T>
T Mipmap<T>::bilinear(size_t index, const vec2& st, TextureWrap wrap) const {
  if (!std::isfinite(st.x) || !std::isfinite(st.y)) return T(nan);
  const Level& level = levels_[index];
  const Axis x = axis(st.x, level.width, wrap), y = axis(st.y, level.height, wrap);
  const auto row = [&](int j) {
    return at(level, x.low, j, wrap) * (1.f - x.fraction) + at(level, x.high, j, wrap) * x.fraction;
  };
  const T upper = row(y.low), lower = row(y.high);
  return upper * (1.f - y.fraction) + lower * y.fraction;
}

template <typename T>
float Mipmap<T>::level_of(float width) const {
  const auto size = static_cast<float>(std::max(levels_[0].width, levels_[0].height));
  const auto last = static_cast<float>(levels_.size() - 1);
  if (!std::isfinite(width * size)) return last;
  return std::min(std::log2(std::max(width * size, 1.f)), last);
}

template <typename T>
T Mipmap<T>::trilinear(const vec2& st, float width, TextureWrap wrap) const {
  const float level = level_of(width);
  const auto low = static_cast<size_t>(level);
  const float fraction = level - static_cast<float>(low);
  const T fine = bilinear(low, st, wrap);
  if (fraction == 0.f) return fine;
  return fine * (1.f - fraction) + bilinear(low + 1, st, wrap) * fraction;
}

template <typename T>
T Mipmap<T>::ewa(const vec2& st, vec2 d0, vec2 d1, TextureWrap wrap, float most_anisotropy) const {
  if (glm::dot(d0, d0) < glm::dot(d1, d1)) std::swap(d0, d1);
  const float longer = glm::length(d0);
  float shorter = glm::length(d1);
  if (shorter * most_anisotropy < longer && shorter > 0.f) {
    d1 *= longer / (shorter * most_anisotropy);
    shorter = longer / most_anisotropy;
  }
  // Overflow and what is not a number end at the coarsest level.
  if (!(shorter > 0.f) || !std::isfinite(longer)) return trilinear(st, longer, wrap);
  const float level = level_of(shorter);
  const auto low = static_cast<size_t>(level);
  const float fraction = level - static_cast<float>(low);
  const T fine = ellipse(low, st, d0, d1, wrap);
  if (fraction == 0.f) return fine;
  return fine * (1.f - fraction) + ellipse(low + 1, st, d0, d1, wrap) * fraction;
}

template <typename T>
T Mipmap<T>::ellipse(size_t index, const vec2& st, const vec2& d0, const vec2& d1,
                     TextureWrap wrap) const {
  // One texel stands for the whole image, however large the ellipse.
  if (index + 1 == levels_.size()) return bilinear(index, st, wrap);
  if (!std::isfinite(st.x) || !std::isfinite(st.y)) return T(nan);
  const Level& level = levels_[index];
  const vec2 size(static_cast<float>(level.width), static_cast<float>(level.height));
  const vec2 center = vec2(reduced(st.x, wrap), reduced(st.y, wrap)) * size - 0.5f;
  // Implicit form A x^2 + B x y + C y^2 < F of the ellipse with half axes d0/2, d1/2 (Heckbert,
  // section 3.5.8), at least about one texel wide so that it never falls between texels.
  const vec2 a0 = 0.5f * d0 * size, a1 = 0.5f * d1 * size;
  const float a = sqr(a0.y) + sqr(a1.y) + 1.f, c = sqr(a0.x) + sqr(a1.x) + 1.f;
  const float b = -2.f * (a0.x * a0.y + a1.x * a1.y);
  const float f = a * c - 0.25f * b * b;
  const float rx = std::sqrt(c), ry = std::sqrt(a);
  const auto x0 = static_cast<int>(std::ceil(center.x - rx));
  const auto x1 = static_cast<int>(std::floor(center.x + rx));
  const auto y0 = static_cast<int>(std::ceil(center.y - ry));
  const auto y1 = static_cast<int>(std::floor(center.y + ry));
  T sum(0.f);
  float weights = 0.f;
  for (int y = y0; y <= y1; ++y) {
    const float dy = static_cast<float>(y) - center.y;
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x) - center.x;
      const float r2 = (a * dx * dx + b * dx * dy + c * dy * dy) / f;
      if (r2 >= 1.f) continue;
      // A Gaussian that ends at 0 where the ellipse does.
      const float weight = std::exp(-2.f * r2) - std::exp(-2.f);
      sum +=
          at(level, wrapped(x, level.width, wrap), wrapped(y, level.height, wrap), wrap) * weight;
      weights += weight;
    }
  }
  return weights > 0.f ? sum * (1.f / weights) : bilinear(index, st, wrap);
}

template class Mipmap<float>;
template class Mipmap<Rgb>;

}  // namespace pssmlt
