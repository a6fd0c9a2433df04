// Isotropic tables over half and difference angles: the MERL BRDF database (Matusik et al. 2003, A
// Data-Driven Reflectance Model; coordinates: Rusinkiewicz 1998). Three integers, usually 90, 90
// and 180, then as many doubles for red, green and blue each, which factors of the database turn to
// 1/sr. theta_h goes by the square root, theta_d and phi_d are even; the value of a cell is taken
// as that of its middle and interpolated between cells that have one: negative numbers mean none.
// phi_d and phi_d + pi are the same cell, so that f is symmetric.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/distribution.h"
#include "core/measured/measured_brdf.h"

namespace pssmlt {

class MerlBrdf final : public MeasuredBrdf {
 public:
  // Throws Error with a message that names no place.
  explicit MerlBrdf(const std::string& path);
  // True if a file's first 12 bytes may be the three integers.
  static bool recognises(const std::string& start);

  Rgb eval(const vec3& wo, const vec3& wi) const override;
  float pdf(const vec3& wo, const vec3& wi) const override;
  std::optional<vec3> sample(const vec3& wo, float u_lobe, const vec2& u) const override;

 private:
  struct Place {
    int low = 0, high = 0;  // cells
    float share = 0.f;      // of the higher
  };
  static Place place(float x, int count);     // ends stay
  static Place periodic(float x, int count);  // ends meet
  const Rgb& cell(int h, int d, int p) const {
    return cells_[(static_cast<size_t>(h) * static_cast<size_t>(counts_[1]) +
                   static_cast<size_t>(d)) *
                      static_cast<size_t>(counts_[2]) +
                  static_cast<size_t>(p)];
  }
  void read(const std::string& path);
  // Fits the distribution of half vectors and the share of the cosine to the table.
  void fit();
  std::vector<double> mean_luminances() const;
  // Edge i of the cells of theta_h [rad], and 1 - cos of it, with all digits.
  double edge(int i) const;
  double versine(int i) const;
  float pdf_half(const vec3& m) const;  // [1/sr]

  std::array<int, 3> counts_{};  // of theta_h, theta_d, phi_d
  std::vector<Rgb> cells_;       // [1/sr]; negative: no value
  Distribution1D half_;          // over cells of theta_h
  float cosine_share_ = 1.f;
};

}  // namespace pssmlt
