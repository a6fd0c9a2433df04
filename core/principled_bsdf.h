// The scattering of the metallic-roughness material of glTF 2.0 (Khronos Group 2021, appendix B)
// and its extensions, as a sum of lobes:
//
//   coat + sheen + min(T(wo), T(wi)) (specular + through) + diffuse
//
// specular: one GGX lobe for metal and for the dielectric's surface, F = a + b (1 - c)^5 (Schlick).
// through:  of transmitting dielectrics. Thin: the specular lobe turned to the other side. With a
//           volume: refraction and reflection at one boundary (core/rough_interface.h), exact
//           Fresnel, both by `eta`, which may follow the wavelength; f0, and so all other lobes
//           and what reaches them, do not.
// T:        what coat and sheen let pass, by their tabulated albedos; the smaller one of both
//           directions keeps the sum reciprocal and below one.
// diffuse:  (1 - E(wo)) (1 - E(wi)) / (pi (1 - mean E)) base, where E is the albedo of all that
//           lies above (Kulla, Conty 2017): a white base under any surface reflects all the light,
//           where the specification's weights by the half vector gain some at grazing angles.
//
// Lobes are chosen by probabilities that depend on wo alone; pdf() is the sum over them.
#pragma once

#include "core/bsdf.h"
#include "core/ggx_albedo.h"
#include "core/rough_interface.h"

namespace pssmlt {

// A point of the material. Shares and colours lie in [0, 1].
struct PrincipledPoint {
  Rgb base{0.8f};
  float metallic = 0.f;
  vec2 alpha{0.25f};         // widths along the lobe's own axes
  vec2 axis{1.f, 0.f};       // cosine and sine of the first axis's angle to the tangent
  float eta = 1.5f;          // index of the inside over that of the outside
  Rgb f0{0.04f};             // of the dielectric, at normal incidence
  float f90 = 1.f;           // of the dielectric, grazing
  float transmission = 0.f;  // share of the dielectric that light passes
  bool thin = true;          // no refraction
  float coat = 0.f, coat_alpha = 0.f;
  Rgb sheen{0.f};
  float sheen_roughness = 0.f;
};

class PrincipledBsdf final : public Bsdf {
 public:
  explicit PrincipledBsdf(const PrincipledPoint& p);

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override;
  float pdf(const vec3& wo, const vec3& wi) const override;
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override;
  bool connectible() const override;
  Rgb albedo(const vec3& wo) const override;

 private:
  // Probabilities of the lobes; they sum to one, or are all zero.
  struct Shares {
    float specular = 0.f, through = 0.f, diffuse = 0.f, coat = 0.f, sheen = 0.f;
  };
  Shares shares(const vec3& wo) const;
  // What passes the coat, and what passes coat and sheen.
  float past_coat(float mu) const;
  float past_layers(float mu) const;
  // 1 - E of all that lies above the diffuse base.
  float reaches_base(float mu) const;
  float mean_reaching_base() const;
  SchlickAlbedo surface_albedo(float mu) const;

  // In the frame of the lobe's axes.
  Rgb value(const vec3& wo, const vec3& wi, Transport mode) const;
  float density(const vec3& wo, const vec3& wi) const;
  Rgb same_side(const vec3& wo, const vec3& wi) const;
  Rgb thin_value(const vec3& wo, const vec3& wi) const;
  std::optional<BsdfSample> mirrored(const vec3& wo, const Rgb& value, float share) const;
  std::optional<BsdfSample> passed_thin(const vec3& wo, float share) const;
  std::optional<BsdfSample> passed_smooth(const vec3& wo, float u, float share,
                                          Transport mode) const;
  std::optional<vec3> reflected(const Ggx& ggx, const vec3& wo, const vec2& u) const;
  std::optional<BsdfSample> sample_local(const vec3& wo, float u_lobe, const vec2& u,
                                         Transport mode) const;
  std::optional<vec3> direction(const Shares& s, const vec3& wo, float u_lobe, const vec2& u) const;
  Rgb schlick(float cosine) const;  // of the specular lobe, its weights included
  Rgb surface(float cosine) const;  // of the dielectric alone
  bool has_layers() const { return coat_ > 0.f || sheen_most_ > 0.f; }
  bool volume() const { return !thin_ && through_most_ > 0.f; }

  Rgb a_, b_;    // F of the specular lobe: a + b (1 - c)^5
  Rgb f0_;       // of the dielectric
  Rgb diffuse_;  // weight of the base / pi / mean (1 - E)
  Rgb through_;  // weight and tint of what passes
  Rgb sheen_;
  float f0_most_, f90_, eta_;
  float glass_;  // weight of the boundary of a volume
  float through_most_, diffuse_most_, sheen_most_;
  float coat_, sheen_roughness_;
  vec2 axis_;
  float table_alpha_;
  bool thin_, smooth_, coat_smooth_;
  Ggx ggx_, coat_ggx_;
};

}  // namespace pssmlt
