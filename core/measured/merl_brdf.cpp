#include "core/measured/merl_brdf.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/base/warp.h"
#include "core/microfacet.h"

namespace pssmlt {
namespace {

constexpr int most_cells = 4096;                                     // of an axis
constexpr dvec3 scales(1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0);  // of the database
constexpr float right_angle = 0.5f * pi;
const Rgb no_value(-1.f);

// Rusinkiewicz' angles [rad]; phi_d in [0, pi].
struct HalfDifference {
  float theta_h, theta_d, phi_d;
};
HalfDifference half_difference(const vec3& wo, const vec3& wi) {
  const vec3 sum = wo + wi;
  const float across = std::sqrt(sqr(sum.x) + sqr(sum.y)), length = glm::length(sum);
  // wi turned so that the half vector becomes z: by -phi_h about z, by -theta_h about y.
  const vec2 axis = across > 0.f ? vec2(sum.x, sum.y) / across : vec2(1.f, 0.f);
  const vec3 turned(wi.x * axis.x + wi.y * axis.y, wi.y * axis.x - wi.x * axis.y, wi.z);
  const float x = (turned.x * sum.z - turned.z * across) / length;
  const float z = (turned.x * across + turned.z * sum.z) / length;
  const float phi = std::atan2(turned.y, x);
  return {std::atan2(across, sum.z), std::atan2(std::sqrt(sqr(x) + sqr(turned.y)), z),
          phi < 0.f ? phi + pi : phi};
}

std::array<int, 3> counts_in(const std::string& start) {
  std::array<int, 3> counts{};
  std::memcpy(counts.data(), start.data(), sizeof counts);
  return counts;
}

}  // namespace

bool MerlBrdf::recognises(const std::string& start) {
  return std::ranges::all_of(counts_in(start), [](int n) { return n > 0 && n <= most_cells; });
}

MerlBrdf::MerlBrdf(const std::string& path) {
  read(path);
  fit();
}

void MerlBrdf::read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string start(12, ' ');
  if (!in.read(start.data(), 12) || !recognises(start)) throw Error("this is no MERL table");
  counts_ = counts_in(start);
  const uint64_t count = uint64_t{1} * static_cast<uint64_t>(counts_[0]) *
                         static_cast<uint64_t>(counts_[1]) * static_cast<uint64_t>(counts_[2]);
  std::error_code failed;
  const uint64_t size = std::filesystem::file_size(path, failed);
  const uint64_t expected = 12 + 3 * sizeof(double) * count;
  if (failed || size != expected)
    throw Error("a MERL table of " + std::to_string(counts_[0]) + " x " +
                std::to_string(counts_[1]) + " x " + std::to_string(counts_[2]) + " cells has " +
                std::to_string(expected) + " bytes, this file " + std::to_string(size));
  cells_.resize(count);
  std::vector<double> row(static_cast<size_t>(counts_[2]));
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < count; ++i) {
      const size_t at = i % row.size();
      if (at == 0 && !in.read(reinterpret_cast<char*>(row.data()),
                              static_cast<std::streamsize>(row.size() * sizeof(double))))
        throw Error("the table cannot be read");
      const auto value = static_cast<float>(row[at] * scales[channel]);
      if (!std::isfinite(value)) throw Error("the table has a value that is not finite");
      cells_[i][channel] = value;
    }
  }
  for (Rgb& c : cells_)
    if (!is_valid(c)) c = no_value;
}

MerlBrdf::Place MerlBrdf::place(float x, int count) {
  const float middle = std::clamp(x - 0.5f, 0.f, static_cast<float>(count - 1));
  const int low = std::min(static_cast<int>(middle), std::max(count - 2, 0));
  return {low, std::min(low + 1, count - 1), middle - static_cast<float>(low)};
}

MerlBrdf::Place MerlBrdf::periodic(float x, int count) {
  const float below = std::floor(x - 0.5f);
  const int low = (static_cast<int>(below) + count) % count;
  return {low, (low + 1) % count, x - 0.5f - below};
}

Rgb MerlBrdf::eval(const vec3& wo, const vec3& wi) const {
  if (!(wo.z > 0.f) || !(wi.z > 0.f)) return Rgb(0.f);
  const HalfDifference a = half_difference(wo, wi);
  const auto scaled = [](float part, int n) { return part * static_cast<float>(n); };
  const Place h = place(scaled(std::sqrt(a.theta_h / right_angle), counts_[0]), counts_[0]);
  const Place d = place(scaled(a.theta_d / right_angle, counts_[1]), counts_[1]);
  const Place p = periodic(scaled(a.phi_d / pi, counts_[2]), counts_[2]);
  Rgb value(0.f);
  float known = 0.f;
  for (int i = 0; i < 8; ++i) {
    const bool high_h = (i & 1) != 0, high_d = (i & 2) != 0, high_p = (i & 4) != 0;
    const Rgb& c = cell(high_h ? h.high : h.low, high_d ? d.high : d.low, high_p ? p.high : p.low);
    if (c.x < 0.f) continue;
    const float weight = (high_h ? h.share : 1.f - h.share) * (high_d ? d.share : 1.f - d.share) *
                         (high_p ? p.share : 1.f - p.share);
    value += weight * c;
    known += weight;
  }
  return known > 0.f ? value / known : Rgb(0.f);
}

double MerlBrdf::edge(int i) const {
  return static_cast<double>(right_angle) * sqr(static_cast<double>(i) / counts_[0]);
}
double MerlBrdf::versine(int i) const { return 2.0 * sqr(std::sin(0.5 * edge(i))); }

// Of each cell of theta_h over all others with a value; differences past 60 degrees, where Fresnel
// reflection rises, say little about the distribution.
std::vector<double> MerlBrdf::mean_luminances() const {
  std::vector<double> means;
  for (int h = 0; h < counts_[0]; ++h) {
    double sum = 0.0;
    int known = 0;
    for (int d = 0; d < std::max(1, counts_[1] * 2 / 3); ++d)
      for (int p = 0; p < counts_[2]; ++p) {
        const Rgb& c = cell(h, d, p);
        if (c.x < 0.f) continue;
        sum += static_cast<double>(luminance(c));
        ++known;
      }
    means.push_back(known > 0 ? sum / known : 0.0);
  }
  return means;
}

// What lies above the lower quarter of the values is taken for a highlight, that for a base like a
// Lambertian one; each is sampled by its share of the light at normal incidence.
void MerlBrdf::fit() {
  const std::vector<double> means = mean_luminances();
  std::vector<double> sorted = means;
  std::ranges::sort(sorted);
  const double base = sorted[sorted.size() / 4];
  std::vector<double> weights;
  double highlight = 0.0;
  for (int i = 0; i < counts_[0]; ++i) {
    const double cosine = std::cos(0.5 * (edge(i) + edge(i + 1)));
    const double ring = 2.0 * std::numbers::pi * (versine(i + 1) - versine(i));
    const double above = std::max(means[static_cast<size_t>(i)] - base, 0.0);
    // Not quite zero, so that neighbours of a narrow peak are found as well.
    weights.push_back((above + 0.01 * base) * cosine * ring);
    highlight += above * ring * 4.0 * cosine * std::max(2.0 * cosine * cosine - 1.0, 0.0);
  }
  half_ = Distribution1D(std::span<const double>(weights));
  const double lambertian = std::numbers::pi * base;
  if (half_.sum() > 0.0 && highlight + lambertian > 0.0)
    cosine_share_ =
        static_cast<float>(std::clamp(lambertian / (highlight + lambertian), 0.1, 0.95));
}

float MerlBrdf::pdf_half(const vec3& m) const {
  const double theta =
      std::atan2(std::sqrt(static_cast<double>(sqr(m.x) + sqr(m.y))), static_cast<double>(m.z));
  const double x = std::sqrt(theta / static_cast<double>(right_angle)) * counts_[0];
  const int i = std::clamp(static_cast<int>(x), 0, counts_[0] - 1);
  return static_cast<float>(half_.probability(static_cast<size_t>(i)) /
                            (2.0 * std::numbers::pi * (versine(i + 1) - versine(i))));
}

float MerlBrdf::pdf(const vec3& wo, const vec3& wi) const {
  if (!(wo.z > 0.f) || !(wi.z > 0.f)) return 0.f;
  const float cosine = cosine_share_ * wi.z * inv_pi;
  if (cosine_share_ == 1.f) return cosine;
  const vec3 m = glm::normalize(wo + wi);
  return cosine + (1.f - cosine_share_) * pdf_half(m) / (4.f * glm::dot(wo, m));
}

std::optional<vec3> MerlBrdf::sample(const vec3& wo, float u_lobe, const vec2& u) const {
  if (u_lobe < cosine_share_) return cosine_hemisphere(u);
  // Uniform by solid angle within the cell.
  const auto ring = half_.sample(static_cast<double>(u.x));
  const auto i = static_cast<int>(ring.index);
  const double v = versine(i) + ring.offset * (versine(i + 1) - versine(i));
  const auto sine = static_cast<float>(std::sqrt(std::max(v * (2.0 - v), 0.0)));
  const float phi = 2.f * pi * u.y;
  const vec3 m(sine * std::cos(phi), sine * std::sin(phi), static_cast<float>(1.0 - v));
  if (!(glm::dot(wo, m) > 0.f)) return std::nullopt;
  return glm::normalize(reflect(wo, m));
}

}  // namespace pssmlt
