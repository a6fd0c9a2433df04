#include "core/noise.h"

#include <algorithm>
#include <array>

namespace pssmlt {
namespace {

// Perlin 2002.
constexpr std::array<uint8_t, 256> permutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

// Toward the middles of a cube's edges; four of them twice.
constexpr std::array<int8_t, 16> gradient_x = {1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0, 1, -1, 0, 0};
constexpr std::array<int8_t, 16> gradient_y = {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1, 1, 1, 1, -1};
constexpr std::array<int8_t, 16> gradient_z = {0, 0, 0,  0,  1, 1, -1, -1,
                                               1, 1, -1, -1, 0, 0, -1, -1};

constexpr float lacunarity = 1.99f;     // not 2, so that lattices of octaves do not coincide
constexpr float mean_magnitude = 0.2f;  // of noise
constexpr float fade_in = 0.3f, fade_out = 0.7f;  // share of the last octave between none and all

uint8_t permuted(int i) { return permutation[static_cast<size_t>(i & 255)]; }

// The lattice point's gradient times the way from there.
float slope(int x, int y, int z, const vec3& d) {
  const size_t g = permuted(permuted(permuted(x) + y) + z) & 15;
  return static_cast<float>(gradient_x[g]) * d.x + static_cast<float>(gradient_y[g]) * d.y +
         static_cast<float>(gradient_z[g]) * d.z;
}

// 6 t^5 - 15 t^4 + 10 t^3: first and second derivative vanish at 0 and 1.
vec3 fade(const vec3& t) { return t * t * t * (t * (t * 6.f - 15.f) + 10.f); }

float mix(float a, float b, float t) { return a + t * (b - a); }

// Octaves that are at least two pixels wide.
float visible(const Octaves& o) {
  const auto most = static_cast<float>(o.count);
  return o.footprint > 0.f ? std::clamp(-1.f - std::log2(o.footprint), 0.f, most) : most;
}

// The share of the octave that is only partly visible.
float partial(float fraction) {
  const float t = std::clamp((fraction - fade_in) / (fade_out - fade_in), 0.f, 1.f);
  return t * t * (3.f - 2.f * t);
}

}  // namespace

float noise(const vec3& p) {
  const vec3 cell = glm::floor(p), d = p - cell;
  if (!is_finite(d)) return std::numeric_limits<float>::quiet_NaN();
  // Exact for any finite number, unlike a conversion to an integer.
  const vec3 low = cell - 256.f * glm::floor(cell / 256.f);
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y), z = static_cast<int>(low.z);
  const vec3 t = fade(d);
  const auto along_x = [&](int j, int k) {
    const vec3 e = d - vec3(0.f, static_cast<float>(j), static_cast<float>(k));
    return mix(slope(x, y + j, z + k, e), slope(x + 1, y + j, z + k, e - vec3(1.f, 0.f, 0.f)), t.x);
  };
  return mix(mix(along_x(0, 0), along_x(1, 0), t.y), mix(along_x(0, 1), along_x(1, 1), t.y), t.z);
}

float fbm(const vec3& p, const Octaves& octaves) {
  const float count = visible(octaves);
  const int whole = static_cast<int>(count);
  float sum = 0.f, frequency = 1.f, weight = 1.f;
  for (int i = 0; i < whole; ++i) {
    sum += weight * noise(frequency * p);
    frequency *= lacunarity;
    weight *= octaves.roughness;
  }
  const float rest = partial(count - static_cast<float>(whole));
  return rest > 0.f ? sum + weight * rest * noise(frequency * p) : sum;
}

float turbulence(const vec3& p, const Octaves& octaves) {
  const float count = visible(octaves);
  const int whole = static_cast<int>(count);
  float sum = 0.f, frequency = 1.f, weight = 1.f;
  for (int i = 0; i < whole; ++i) {
    sum += weight * std::abs(noise(frequency * p));
    frequency *= lacunarity;
    weight *= octaves.roughness;
  }
  float rest = partial(count - static_cast<float>(whole));
  for (int i = whole; i < octaves.count; ++i) {
    const float seen = rest > 0.f ? std::abs(noise(frequency * p)) : 0.f;
    sum += weight * mix(mean_magnitude, seen, rest);
    weight *= octaves.roughness;
    rest = 0.f;
  }
  return sum;
}

}  // namespace pssmlt
