// Reflection as it was measured: the tensor files of the RGL's database (.bsdf; Dupuy and Jakob
// 2018) and the tables of the MERL database (.binary; Matusik et al. 2003), told apart by what they
// hold. Both sides of a surface are alike. The data are used as they are: where a table reflects
// more than it gets, the log says so; where it is not symmetric, importance gets the exact adjoint.
#include <fmt/format.h>

#include <array>

#include "core/base/log.h"
#include "core/material_base.h"
#include "core/measured/measured_brdf.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// What is reflected of light from directions evenly spread in their cosine [1], means over
// azimuths.
class AlbedoTable {
 public:
  AlbedoTable() = default;
  explicit AlbedoTable(const MeasuredBrdf& brdf) {
    for (int i = 0; i < size; ++i) values_[static_cast<size_t>(i)] = integrate(brdf, cosine(i));
  }
  Rgb operator()(float mu) const {
    const float at = std::abs(mu) * float{size} - 0.5f;
    const int low = std::clamp(static_cast<int>(at), 0, size - 2);
    const float share = std::clamp(at - static_cast<float>(low), 0.f, 1.f);
    return glm::mix(values_[static_cast<size_t>(low)], values_[static_cast<size_t>(low) + 1],
                    share);
  }
  // The entry with the largest component.
  int most() const {
    const auto less = [](const Rgb& a, const Rgb& b) {
      return max_component(a) < max_component(b);
    };
    return static_cast<int>(std::ranges::max_element(values_, less) - values_.begin());
  }
  static float cosine(int i) { return (static_cast<float>(i) + 0.5f) / size; }

 private:
  static constexpr int size = 16, azimuths = 4, grid = 24;

  static Rgb integrate(const MeasuredBrdf& brdf, float mu) {
    Rgb sum(0.f);
    for (int k = 0; k < azimuths; ++k) {
      const float phi = 2.f * pi * (static_cast<float>(k) + 0.3f) / azimuths;
      const float sine = safe_sqrt(1.f - mu * mu);
      const vec3 wo(sine * std::cos(phi), sine * std::sin(phi), mu);
      for (int n = 0; n < grid * grid; ++n) {
        // Lobes by the golden ratio's multiples, which fill [0, 1) evenly.
        const float lobe = static_cast<float>(n) * 0.61803399f;
        const vec2 u((static_cast<float>(n % grid) + 0.5f) / grid,
                     (static_cast<float>(n / grid) + 0.5f) / grid);
        const auto wi = brdf.sample(wo, lobe - std::floor(lobe), u);
        if (!wi || !(wi->z > 0.f)) continue;
        sum += brdf.eval(wo, *wi) * (wi->z / brdf.pdf(wo, *wi));
      }
    }
    return sum / float{azimuths * grid * grid};
  }

  std::array<Rgb, size> values_{};
};

class MeasuredBsdf final : public Bsdf {
 public:
  MeasuredBsdf(const MeasuredBrdf& brdf, const AlbedoTable& albedo)
      : brdf_(brdf), albedo_(albedo) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override {
    if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
    return mode == Transport::radiance ? brdf_.eval(up(wo, wo), up(wo, wi))
                                       : brdf_.eval(up(wo, wi), up(wo, wo));
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    return wo.z * wi.z > 0.f ? brdf_.pdf(up(wo, wo), up(wo, wi)) : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override {
    if (wo.z == 0.f) return std::nullopt;
    const auto wi = brdf_.sample(up(wo, wo), u_lobe, u);
    if (!wi || !(wi->z > 0.f)) return std::nullopt;
    BsdfSample s;
    s.wi = up(wo, *wi);
    s.pdf = pdf(wo, s.wi);
    if (!(s.pdf > 0.f) || !std::isfinite(s.pdf)) return std::nullopt;
    s.weight = eval(wo, s.wi, mode) * (wi->z / s.pdf);
    s.pdf_reverse = pdf(s.wi, wo);
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override { return albedo_(wo.z); }

 private:
  // w as seen from the side of wo: below the surface both directions are turned around.
  static vec3 up(const vec3& wo, const vec3& w) { return wo.z < 0.f ? -w : w; }
  const MeasuredBrdf& brdf_;
  const AlbedoTable& albedo_;
};

class Measured final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "reflection from a file of measurements";

  explicit Measured(Parameters& p) : BumpedMaterial(p) {
    const std::string path =
        p.file("filename", "a tensor file of the RGL (.bsdf) or a MERL table (.binary)");
    if (p.describing()) return;
    if (path.empty()) p.fail("\"filename\" is missing: the file with the measurements");
    try {
      brdf_ = read_measured_brdf(path);
    } catch (const Error& e) {
      p.fail("filename", "'" + path + "': " + e.what());
    }
    albedo_ = AlbedoTable(*brdf_);
    report(p);
  }

  const Bsdf* bsdf(const Hit&, MaterialNumbers, BsdfStorage& storage) const override {
    return storage.make<MeasuredBsdf>(*brdf_, albedo_);
  }
  MaterialTraits traits() const override { return {.diffuse_lobes = true}; }

 private:
  void report(const Parameters& p) const {
    const float cosine = AlbedoTable::cosine(albedo_.most());
    const float most = max_component(albedo_(cosine));
    constexpr float noticeable = 1.02f;  // beyond the estimate's own error
    if (most > noticeable)
      log_warning(
          fmt::format("{}: {}: the measurements reflect up to {:.2f} of the light, from {:.0f} "
                      "degrees: they are used as they are",
                      to_string(p.where()), p.owner(), most, std::acos(cosine) * 180.f / pi));
  }
  std::shared_ptr<const MeasuredBrdf> brdf_;
  AlbedoTable albedo_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "measured", pssmlt::Measured)
