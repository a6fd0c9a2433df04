// Measured materials of the RGL's database: Dupuy and Jakob 2018, An Adaptive Parameterization for
// Efficient Material Acquisition and Modeling. Isotropic and anisotropic, spectra or rgb.
//
// With the half vector m at u_m, the fields give for the direction wo, at which they are blended,
//   f(wo, wi) cos(wi) = spectra(u) ndf(u_m) / (4 sigma(wo)),   u_m = vndf(wo) applied to u,
// where vndf is the map from uniform points to visible normals. If "jacobian" is 0 it is spectra(u)
// alone. Directions are u = (sqrt(2 theta / pi), phi / (2 pi) + 1/2). Wavelengths become RGB when
// the file is read, as a reflectance lit by D65; what then lies outside of Rec.709 is clipped.
#pragma once

#include <string>
#include <vector>

#include "core/measured/bilinear_warp.h"
#include "core/measured/measured_brdf.h"
#include "core/measured/tensor_file.h"

namespace pssmlt {

class RglBrdf final : public MeasuredBrdf {
 public:
  // Throws Error with a message that names no place.
  explicit RglBrdf(const std::string& path);

  Rgb eval(const vec3& wo, const vec3& wi) const override;
  float pdf(const vec3& wo, const vec3& wi) const override;
  std::optional<vec3> sample(const vec3& wo, float u_lobe, const vec2& u) const override;

 private:
  // Numbers on a grid, not a density.
  struct Field {
    std::vector<float> values;
    int width = 0, height = 0;
    float at(const vec2& u) const;
  };
  // A pair of directions as the table sees it.
  struct Place {
    GridBlend blend;       // of wo
    vec2 wo{0.f}, m{0.f};  // their places in the unit square
    float wo_dot_m = 0.f;
  };
  Place place(const vec3& wo, const vec3& wi) const;
  // The angle that the table is blended by, in its own range [rad].
  float table_azimuth(const vec3& w) const;
  // Factors of x and y that take a pair of directions to the part that was measured.
  vec2 mirroring(const vec3& wo) const;

  void read_axes(TensorFile& file);
  void read_symmetry(const std::vector<float>& phi);
  static Field read_field(TensorFile& file, const std::string& name);
  BilinearWarp read_warp(TensorFile& file, const std::string& name) const;
  // Width and height of the last two of `dimensions`, after the two outer parameters.
  void check_shape(const std::string& name, const std::vector<uint64_t>& shape) const;
  void read_colours(TensorFile& file);
  void read_rgb(TensorFile& file, const std::string& name, const std::vector<dvec3>& weights);
  Rgb colour(const GridBlend& blend, const vec2& u) const;

  GridAxes axes_;  // phi, theta of wo [rad]
  bool isotropic_ = true, jacobian_ = true;
  int symmetry_ = 1;  // 2: half of the azimuths were measured; 4: a quarter
  vec2 middle_{1.f};  // of those azimuths
  Field ndf_, sigma_;
  BilinearWarp visible_, luminance_;
  std::vector<Rgb> colours_;
  int width_ = 0, height_ = 0;  // of colours_
};

}  // namespace pssmlt
