// How far from where it entered diffused light leaves a half space again: photon beam diffusion
// (Habel, Christensen and Jarosz 2013, Photon Beam Diffusion: A Hybrid Monte Carlo Method for
// Subsurface Scattering), for a beam that enters at a right angle.
#pragma once

namespace pssmlt {

// One colour of a medium behind a smooth boundary.
struct DiffusingMedium {
  double scattering = 0.0, absorption = 0.0;  // [1/m]
  double g = 0.0;                             // mean cosine of scattering
  double eta = 1.0;                           // index of the inside over that of the outside

  double extinction() const { return scattering + absorption; }
  double reduced_extinction() const { return scattering * (1.0 - g) + absorption; }
  // Of Grosjean's diffusion [1/m]: diffused light falls off as exp(-attenuation r).
  double attenuation() const;
};

class BeamDiffusion {
 public:
  explicit BeamDiffusion(const DiffusingMedium& medium);
  // What leaves at the distance r > 0 [m] from the beam, per power that has entered [1/m^2]: light
  // that scattered once, and what diffusion makes of the rest.
  double operator()(double r) const;

 private:
  double scattered_once(double r) const;
  double diffused(double r) const;
  // Of a source at depth z [m] and its image above the surface.
  double dipole(double r, double z) const;

  DiffusingMedium medium_;
  double diffusion_ = 0.0;                         // [m]
  double fluence_share_ = 0.0, flux_share_ = 0.0;  // what the boundary lets out of either
  double above_ = 0.0;                             // where the fluence vanishes [m], negative
};

// Mean over the cosine, weighted by its power k, of what a boundary reflects: the integral over mu
// from 0 to 1 of F(mu) mu^k. from_inside: of light that would leave.
double fresnel_moment(int k, double eta, bool from_inside);

}  // namespace pssmlt
