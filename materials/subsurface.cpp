// Skin, wax, marble, milk: a dielectric boundary, smooth or rough, around a medium that scatters.
//
// Source: pbrt-v4's subsurface material for the parameters. Light walks through the medium as
// through any other, so that every integrator sees it and any shape will do, thin ones included;
// each scattering event counts as a bounce. With the method "diffusion" it goes from where it
// enters straight to where it leaves, two bounces in all, by the profile of a half space (photon
// beam diffusion, Habel, Christensen, Jarosz 2013, as pbrt-v4): faster, and wrong where the body is
// thin, sharply bent or clear.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/coat.h"
#include "core/dielectric_bsdf.h"
#include "core/dielectric_index.h"
#include "core/diffusion/boundary_bsdf.h"
#include "core/material_base.h"
#include "core/media/homogeneous_medium.h"
#include "core/media/presets.h"
#include "core/plugin/plugin.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 2> methods = {"walk", "diffusion"};

struct Coefficients {
  Rgb absorption{0.f}, scattering{0.f};  // [1/m]
};

// What a half space without a boundary gives back of light that comes along |cosine| mu, of the
// albedo w of isotropic scattering: 1 - sqrt(1 - w) H(mu), with Chandrasekhar's H as Hapke 2002
// (Bidirectional Reflectance Spectroscopy 5, eq. 13) approximates it, within 1 %.
float given_back(float w, float mu) {
  const float gamma = std::sqrt(1.f - w), r = (1.f - gamma) / (1.f + gamma);
  const float x = std::max(mu, 1e-4f);
  const float h = 1.f / (1.f - w * x * (r + 0.5f * (1.f - 2.f * r * x) * std::log((1.f + x) / x)));
  return 1.f - gamma * h;
}

// What a half space behind a boundary of index eta gives back of the diffuse light that has
// entered; the boundary reflects `back` of diffuse light from inside.
float given_back_through(float w, float eta, float back) {
  constexpr int points = 16;
  float refracted = 0.f, diffuse = 0.f;
  for (int i = 0; i < points; ++i) {
    const float mu2 = (static_cast<float>(i) + 0.5f) / points;  // even under a cosine
    refracted += given_back(w, safe_sqrt(1.f - (1.f - mu2) / (eta * eta))) / points;
    diffuse += given_back(w, std::sqrt(mu2)) / points;
  }
  return refracted * (1.f - back) / (1.f - back * diffuse);
}

// The albedo of scattering for which the half space gives back `seen`, by bisection; of directed
// scattering that which is worth as much (similarity: (1 - g) a / (1 - g a) of isotropic).
float scattering_albedo(float seen, float eta, float back, float g) {
  float low = 0.f, high = 1.f;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5f * (low + high);
    (given_back_through(middle, eta, back) < seen ? low : high) = middle;
  }
  return low / (1.f - g + g * low);
}

std::unique_ptr<const DiffusionProfile> profile_of(const MediumPoint& m, float g, float eta) {
  std::array<DiffusingMedium, 3> media;
  for (int i = 0; i < 3; ++i)
    media[static_cast<size_t>(i)] = {static_cast<double>(m.scattering[i]),
                                     static_cast<double>(m.extinction[i] - m.scattering[i]),
                                     static_cast<double>(g), static_cast<double>(eta)};
  return std::make_unique<const DiffusionProfile>(media);
}

class Subsurface final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "dielectric boundary around a medium that scatters";

  explicit Subsurface(Parameters& p)
      : BumpedMaterial(p),
        roughness_(p),
        eta_(read_dielectric_index(p, "eta", 1.33f)),
        diffuses_(p.choice("method", methods[0], methods,
                           "how light goes beneath: a walk through the medium, or the diffusion "
                           "profile of a half space") == methods[1]) {
    const float g = p.number("g", 0.f, "", "mean cosine of scattering inside, in (-1, 1)");
    const float scale = p.number("scale", 1.f, "", "factor of the coefficients inside");
    Coefficients c = read_coefficients(p, g);
    if (!(std::abs(g) < 1.f)) p.fail("g", "\"g\" must lie between -1 and 1");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (p.describing()) return;
    const MediumPoint point{scale * (c.absorption + c.scattering), scale * c.scattering, Rgb(0.f)};
    // The measured coefficients are reduced ones: scattering that is worth as much in all
    // directions alike.
    const float mean_cosine = p.has("name") ? 0.f : g;
    if (diffuses_) {
      profile_ = profile_of(point, mean_cosine, eta_);
    } else {
      interior_ = std::make_shared<const HomogeneousMedium>(point, mean_cosine);
    }
  }

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    if (!std::isfinite(alpha.x) || !std::isfinite(alpha.y)) return invalid_bsdf(storage);
    if (profile_) return make_entry_bsdf(*profile_, Ggx(alpha.x, alpha.y), storage);
    return make_dielectric_bsdf(eta_, Ggx(alpha.x, alpha.y), storage);
  }
  MaterialTraits traits() const override {
    const bool matched = eta_ == 1.f;
    if (diffuses_) return {.diffuse_lobes = true, .delta_lobes = roughness_.may_be_smooth()};
    return {.diffuse_lobes = !matched && roughness_.may_be_rough(),
            .delta_lobes = matched || roughness_.may_be_smooth(),
            .transmits = true};
  }
  std::shared_ptr<const Medium> interior() const override { return interior_; }

 private:
  // One of the four ways to say what is inside.
  Coefficients read_coefficients(Parameters& p, float g) const;
  static Rgb read(Parameters& p, const char* name, const Rgb& fallback, SpectrumUse use,
                  const char* unit, const char* doc);
  Coefficients named(Parameters& p, const std::string& name) const;
  Coefficients from_reflectance(Parameters& p, const Rgb& reflectance, const Rgb& mfp,
                                float g) const;

  RoughnessTextures roughness_;
  float eta_;
  bool diffuses_;  // instead of walking
  std::shared_ptr<const Medium> interior_;
  std::unique_ptr<const DiffusionProfile> profile_;
};

Rgb Subsurface::read(Parameters& p, const char* name, const Rgb& fallback, SpectrumUse use,
                     const char* unit, const char* doc) {
  const auto value = p.rgb_texture(name, fallback, use, unit, doc);
  if (!value->constant()) p.fail(name, "the medium inside is the same everywhere: no textures");
  return value->evaluate(Hit());
}

Coefficients Subsurface::read_coefficients(Parameters& p, float g) const {
  const std::string name = p.text("name", "",
                                  "a measured medium, as \"Skin1\" or \"Wholemilk\"; in 1/mm, so "
                                  "that a scene in metres needs scale 1000");
  const bool reflects = p.has("reflectance"), direct = p.has("sigma_a") || p.has("sigma_s");
  const Rgb reflectance =
      read(p, "reflectance", Rgb(0.f), SpectrumUse::Albedo, "",
           "what comes back of the light that has entered a thick body; with \"mfp\"");
  const Rgb mfp =
      read(p, "mfp", Rgb(1.f), SpectrumUse::Unbounded, "m", "mean free path; with \"reflectance\"");
  const Coefficients given = {read(p, "sigma_a", Rgb(.0011f, .0024f, .014f), SpectrumUse::Unbounded,
                                   "1/m", "absorption coefficient"),
                              read(p, "sigma_s", Rgb(2.55f, 3.21f, 3.77f), SpectrumUse::Unbounded,
                                   "1/m", "scattering coefficient")};
  if (p.describing()) return given;
  if ((name.empty() ? 0 : 1) + (reflects ? 1 : 0) + (direct ? 1 : 0) > 1)
    p.fail("only one of \"name\", \"reflectance\" and \"sigma_a\" with \"sigma_s\" can be given");
  if (p.has("mfp") && !reflects) p.fail("mfp", "\"mfp\" needs \"reflectance\"");
  if (!is_valid(given.absorption)) p.fail("sigma_a", "\"sigma_a\" must not be negative");
  if (!is_valid(given.scattering)) p.fail("sigma_s", "\"sigma_s\" must not be negative");
  if (!name.empty()) return named(p, name);
  return reflects ? from_reflectance(p, reflectance, mfp, g) : given;
}

Coefficients Subsurface::named(Parameters& p, const std::string& name) const {
  const auto found = scattering_preset(name);
  if (!found) {
    p.fail("name", "no measured medium is named \"" + name + "\"" +
                       suggestion(name, scattering_preset_names()));
  }
  return {found->absorption, found->scattering};
}

Coefficients Subsurface::from_reflectance(Parameters& p, const Rgb& reflectance, const Rgb& mfp,
                                          float g) const {
  const float back = std::max(Coat(eta_, 0.f, 0.f).sent_back(), 0.f);
  Coefficients c;
  for (int i = 0; i < 3; ++i) {
    if (!(mfp[i] > 0.f)) p.fail("mfp", "\"mfp\" must be positive");
    const float seen = std::clamp(reflectance[i], 0.f, 0.999f);
    const float albedo =
        diffuses_
            ? static_cast<float>(diffusing_albedo(static_cast<double>(seen), static_cast<double>(g),
                                                  static_cast<double>(eta_)))
            : scattering_albedo(seen, eta_, back, g);
    if (diffuses_ && albedo > 0.9999f)
      p.note("no profile gives back a reflectance of " + std::to_string(seen) +
             " at this g: the brightest there is is used");
    c.scattering[i] = albedo / mfp[i];
    c.absorption[i] = (1.f - albedo) / mfp[i];
  }
  return c;
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "subsurface", pssmlt::Subsurface)
