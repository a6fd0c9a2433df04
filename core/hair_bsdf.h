// Scattering of a hair fibre: d'Eon et al. 2011 (An Energy-Conserving Hair Reflectance Model) with
// the azimuthal lobes, roughness and absorption of Chiang et al. 2016 (A Practical and Controllable
// Hair and Fur Model for Production Path Tracing), after Marschner et al. 2003.
//
// Local x runs along the fibre from root to tip, z is the normal of the sheet that stands for it. A
// path enters at the offset h from the axis, in radii, along local y. With theta the angle to the
// plane across the fibre and phi the azimuth about it,
//   S(wo, wi) = sum over p of M_p(theta_o, theta_i) A_p(wo, h) N_p(phi_i - phi_o, h),
// where p = 0 (R), 1 (TT), 2 (TRT) counts the crossings of the fibre less one and p = 3 holds all
// longer ones. S integrates to sum A_p over all wi, 1 without absorption.
//
// f = S / |cos(z, wi)|: a fibre is as wide from everywhere, so S is light per width, not per area.
// S is not symmetric, as in the papers: what it is for importance is its exact adjoint, f with the
// directions exchanged, so that paths from both ends see the same fibre. A fibre looks the same to
// light from behind its sheet, seen in a mirror: h then has the other sign.
#pragma once

#include <array>

#include "core/bsdf.h"

namespace pssmlt {

// A point of a fibre.
struct HairPoint {
  float h = 0.f;             // offset along local y over the radius, in [-1, 1]
  float eta = 1.55f;         // index of the fibre over that of air
  Rgb sigma_a{0.f};          // absorption [1 / radius]
  float beta_m = 0.3f;       // roughness along the fibre, in [0, 1]
  float beta_n = 0.3f;       // and across it
  float alpha = 0.0349066f;  // tilt of the scales toward the root [rad]
};

// Absorption [1 / radius] of the concentrations of both pigments (d'Eon et al. 2011, section 6.1).
Rgb hair_absorption(float eumelanin, float pheomelanin);
// Absorption [1 / radius] that lets a head of hair reflect c, in [0, 1] (Chiang et al. 2016, eq.
// 9).
Rgb hair_absorption(const Rgb& c, float beta_n);

class HairBsdf final : public Bsdf {
 public:
  explicit HairBsdf(const HairPoint& p);

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override;
  float pdf(const vec3& wo, const vec3& wi) const override;
  // The lobe by the mean of A_p, then M_p and N_p exactly; what is left of u_lobe turns the
  // direction about the cone.
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override;
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override;

 private:
  static constexpr size_t lobes = 4;
  // What a direction toward the camera side decides.
  struct Entry {
    float sine, cosine, phi;               // of theta_o; azimuth
    float gamma_o, gamma_t;                // angles to the normal of the circle, outside and inside
    std::array<Rgb, lobes> attenuation;    // A_p
    std::array<float, lobes> probability;  // of the lobe; all zero where everything is absorbed
    std::array<float, lobes> sine_tilted, cosine_tilted;  // of theta_o, turned by the scales
  };
  Entry enter(const vec3& wo) const;
  void attenuate(Entry& e, float h) const;
  void tilt(Entry& e) const;
  // M_p N_p of wi [1/sr].
  float lobe(const Entry& e, size_t p, const vec3& wi) const;
  Rgb scattered(const Entry& e, const vec3& wi) const;
  float density(const Entry& e, const vec3& wi) const;
  vec3 direction(const Entry& e, size_t p, float turn, const vec2& u) const;
  // Azimuth that a ray gains in p crossings of a smooth circle.
  static float exit_azimuth(const Entry& e, size_t p);

  float h_, gamma_, eta_;
  Rgb sigma_a_;
  std::array<float, lobes> v_;                        // longitudinal variances
  float s_;                                           // azimuthal scale of the logistic
  std::array<float, 3> sine_scales_, cosine_scales_;  // of alpha, 2 alpha, 4 alpha
};

}  // namespace pssmlt
