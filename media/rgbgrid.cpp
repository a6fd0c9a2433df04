// A medium whose absorption, scattering and emission are given on regular grids, by channel, and
// interpolated in between. Source: pbrt-v4's rgbgrid for the parameters. Free flight is exact
// (core/media/lattice.h); its cost grows with the number of cells that a ray crosses.
#include "core/media/density_medium.h"
#include "core/phase_function.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class RgbGrid final : public Medium {
 public:
  static constexpr const char* summary = "coefficients on regular grids, by channel";

  explicit RgbGrid(Parameters& p) {
    const LatticeFrame frame = read_lattice_frame(p);
    std::vector<Rgb> absorption =
        read_values(p, "sigma_a", frame, "absorption coefficients, x fastest, then y, then z");
    std::vector<Rgb> scattering = read_values(p, "sigma_s", frame, "scattering coefficients");
    std::vector<Rgb> radiance =
        read_values(p, "Le", frame, "radiance where the medium is opaque and only absorbs");
    const float emission_scale = p.number("Lescale", 1.f, "", "factor of the emission");
    const float scale = p.number("scale", 1.f, "", "factor of both coefficients");
    g_ = read_anisotropy(p);
    if (p.describing()) return;
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (emission_scale < 0.f) p.fail("Lescale", "\"Lescale\" must not be negative");
    if (absorption.empty() && scattering.empty()) {
      p.fail("an rgbgrid medium needs \"sigma_a\" or \"sigma_s\"");
    }
    if (!radiance.empty() && absorption.empty()) p.fail("Le", "\"Le\" needs \"sigma_a\"");
    // What is not given is 1 everywhere, as in pbrt.
    const size_t count = std::max(absorption.size(), scattering.size());
    if (absorption.empty()) absorption.assign(count, Rgb(1.f));
    if (scattering.empty()) scattering.assign(count, Rgb(1.f));
    for (size_t i = 0; i < count; ++i) {
      absorption[i] *= scale;
      scattering[i] *= scale;
      scatters_ |= !is_black(scattering[i]);
      if (!radiance.empty()) radiance[i] *= emission_scale;
    }
    std::vector<Rgb> extinction = absorption;
    for (size_t i = 0; i < count; ++i) extinction[i] += scattering[i];
    extinction_ = std::make_unique<const Lattice<Rgb>>(frame, std::move(extinction));
    scattering_ = std::make_unique<const Lattice<Rgb>>(frame, std::move(scattering));
    if (!radiance.empty()) {
      radiance_ = std::make_unique<const Lattice<Rgb>>(frame, std::move(radiance));
    }
  }

  MediumTraits traits() const override {
    return {.scatters = scatters_, .emits = radiance_ != nullptr};
  }
  Rgb optical_depth(const Ray& ray) const override { return extinction_->integral(ray); }
  std::optional<float> distance(const Ray& ray, int channel, float depth) const override {
    return extinction_->invert(ray, depth, [channel](const Rgb& c) { return c[channel]; });
  }
  MediumPoint at(const vec3& position) const override {
    MediumPoint point{extinction_->at(position), scattering_->at(position), Rgb(0.f)};
    if (radiance_) {
      const Rgb absorption = glm::max(point.extinction - point.scattering, Rgb(0.f));
      point.emission = absorption * radiance_->at(position);
    }
    return point;
  }
  const Bsdf* phase(const vec3&, BsdfStorage& storage) const override {
    return storage.make<HenyeyGreenstein>(g_);
  }

 private:
  static std::vector<Rgb> read_values(Parameters& p, std::string_view name,
                                      const LatticeFrame& frame, std::string_view doc) {
    std::vector<Rgb> values = p.rgbs(name, "", doc);
    if (p.describing() || values.empty()) return values;
    for (int c = 0; c < 3; ++c) {
      std::vector<float> channel;
      for (const Rgb& v : values) channel.push_back(v[c]);
      check_lattice_values(p, name, frame, channel);
    }
    return values;
  }
  std::unique_ptr<const Lattice<Rgb>> extinction_, scattering_, radiance_;
  float g_ = 0.f;
  bool scatters_ = false;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Medium, "rgbgrid", pssmlt::RgbGrid)
