// A tabulated radial profile of light that leaves a body near where it entered: the Sp of a
// separable subsurface function (Christensen and Burley 2015, section 2; pbrt, 4th edition, 11.4)
//   S(xo, wo, xi, wi) = (1 - F(wo)) Sp(|xo - xi|) (1 - F(wi)) / (pi (1 - mean F)).
#pragma once

#include <array>
#include <vector>

#include "core/base/rgb.h"
#include "core/diffusion/beam_diffusion.h"

namespace pssmlt {

class DiffusionProfile {
 public:
  // One medium a colour component; all have the same index.
  explicit DiffusionProfile(const std::array<DiffusingMedium, 3>& media);

  float eta() const { return eta_; }
  // Of (1 - F(wi)) |cos|, integrated over the directions [sr].
  float leaving() const { return leaving_; }
  // Sp(r) [1/m^2], 0 beyond the component's reach.
  Rgb value(float r) const;
  // Integral of value() over the plane: what comes back of the light that has entered [1]; at most
  // 1, profiles that would give more are scaled.
  Rgb albedo() const { return albedo_; }

  // Radii are drawn by the profile of one component.
  float share(int component) const { return share_[index(component)]; }  // sum is 1
  float reach(int component) const { return channels_[index(component)].radius.back(); }  // [m]
  float sample_radius(int component, float u) const;  // [m]; 0 of one that is black
  // Of points of the plane around the entry [1/m^2].
  float density(int component, float r) const;
  // False if nothing ever leaves.
  bool shines() const { return max_component(albedo_) > 0.f; }

 private:
  // Linear between knots: power within a ring, 2 pi r Sp(r) [1/m], and its integral from 0.
  struct Channel {
    std::vector<float> radius, ring, below;
    float ring_at(float r) const;
  };
  static size_t index(int component) { return static_cast<size_t>(component); }
  static Channel tabulate(const DiffusingMedium& medium);

  std::array<Channel, 3> channels_;
  std::array<float, 3> share_{};
  Rgb albedo_{0.f};
  float eta_ = 1.f, leaving_ = 1.f;
};

// The albedo of scattering, at extinction 1 and the medium's g and eta, for which a profile gives
// back `seen` of what enters; the largest there is if none does.
double diffusing_albedo(double seen, double g, double eta);

}  // namespace pssmlt
