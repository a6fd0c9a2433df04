// A medium whose coefficients are those of a substance times a density that varies in space, and
// that may glow: the common part of uniformgrid, nanovdb and cloud.
#pragma once

#include <memory>
#include <optional>

#include "core/color/blackbody_rgb.h"
#include "core/media/lattice.h"
#include "core/media/medium_parameters.h"

namespace pssmlt {

// Emission of a DensityMedium.
struct Glow {
  // Temperatures and their meaning: (value - offset) * scale [K]; below 100 K nothing is emitted.
  std::unique_ptr<const Lattice<float>> temperature;
  float offset = 0.f, scale = 1.f;
  // Radiance [W/(m^2 sr)] where there is no temperature, and the factor of both over space.
  Rgb radiance{0.f};
  std::unique_ptr<const Lattice<float>> factor;  // null: factor_constant everywhere
  float factor_constant = 1.f;
  bool any() const {
    return (factor || factor_constant > 0.f) && (temperature || !is_black(radiance));
  }
};

// Null density only while parameters are described.
struct DensityParts {
  ScatteringParameters substance;                 // where the density is 1
  std::unique_ptr<const Lattice<float>> density;  // [1], not negative
  Glow glow;
};

class DensityMedium : public Medium {
 public:
  explicit DensityMedium(DensityParts parts);

  MediumTraits traits() const final;
  Rgb optical_depth(const Ray& ray) const final;
  std::optional<float> distance(const Ray& ray, int channel, float depth) const final;
  MediumPoint at(const vec3& position) const final;
  const Bsdf* phase(const vec3& position, BsdfStorage& storage) const final;

 private:
  Rgb emitted_radiance(const vec3& position) const;
  ScatteringParameters substance_;
  Rgb extinction_;
  std::unique_ptr<const Lattice<float>> density_;
  Glow glow_;
  std::optional<BlackbodyRgb> blackbody_;
};

std::unique_ptr<const Lattice<float>> make_lattice(const LatticeFrame& frame,
                                                   std::vector<float> values);
// "nx", "ny", "nz", "p0", "p1": how many values a grid has and the box that it fills.
LatticeFrame read_lattice_frame(Parameters& p);
// As many values as the frame wants, none negative; fails at `name` otherwise.
void check_lattice_values(Parameters& p, std::string_view name, const LatticeFrame& frame,
                          const std::vector<float>& values);
// "temperaturescale" and "temperatureoffset" (or "temperaturecutoff", its older name).
void read_temperature_range(Parameters& p, Glow& glow);

}  // namespace pssmlt
