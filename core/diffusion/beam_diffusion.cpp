#include "core/diffusion/beam_diffusion.h"

#include <cmath>
#include <numbers>

#include "core/base/math.h"
#include "core/color/fresnel.h"

namespace pssmlt {
namespace {

constexpr int depths = 100;  // points along the beam
constexpr double inv_4_pi = 0.25 * std::numbers::inv_pi;

// Depths [m] at which even parts of the beam are used up, for the coefficient [1/m].
double depth(int i, double coefficient) {
  return -std::log(1.0 - (i + 0.5) / depths) / coefficient;
}

// Grosjean's diffusion coefficient [m], which is better close to the beam than the classical one.
double grosjean(const DiffusingMedium& m) {
  const double s = m.scattering * (1.0 - m.g), t = m.reduced_extinction();
  return (2.0 * m.absorption + s) / (3.0 * t * t);
}

double henyey_greenstein(double cosine, double g) {
  const double d = 1.0 + g * g + 2.0 * g * cosine;
  return inv_4_pi * (1.0 - g * g) / (d * std::sqrt(d));
}

}  // namespace

double DiffusingMedium::attenuation() const { return std::sqrt(absorption / grosjean(*this)); }

double fresnel_moment(int k, double eta, bool from_inside) {
  constexpr int points = 256;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double mu = (i + 0.5) / points;
    const auto cosine = static_cast<float>(from_inside ? -mu : mu);
    sum +=
        static_cast<double>(fresnel_dielectric(cosine, static_cast<float>(eta))) * std::pow(mu, k);
  }
  return sum / points;
}

BeamDiffusion::BeamDiffusion(const DiffusingMedium& medium)
    : medium_(medium), diffusion_(grosjean(medium)) {
  const double back1 = fresnel_moment(1, medium.eta, true);
  const double back2 = fresnel_moment(2, medium.eta, true);
  fluence_share_ = 0.25 * (1.0 - 2.0 * back1);
  flux_share_ = 0.5 * (1.0 - 3.0 * back2);
  above_ = -2.0 * diffusion_ * (1.0 + 3.0 * back2) / (1.0 - 2.0 * back1);
}

// The boundary's conditions hold on the plane midway (Farrell, Patterson and Wilson 1992).
double BeamDiffusion::dipole(double r, double z) const {
  const double image = 2.0 * above_ - z, attenuation = medium_.attenuation();
  const double here = std::hypot(r, z), there = std::hypot(r, image);
  const double a = std::exp(-attenuation * here), b = std::exp(-attenuation * there);
  const double fluence = inv_4_pi / diffusion_ * (a / here - b / there);
  const double flux =
      inv_4_pi * (z * (1.0 + attenuation * here) * a / (here * here * here) -
                  image * (1.0 + attenuation * there) * b / (there * there * there));
  return fluence * fluence_share_ + flux * flux_share_;
}

double BeamDiffusion::diffused(double r) const {
  const double t = medium_.reduced_extinction();
  const double albedo = medium_.scattering * (1.0 - medium_.g) / t;
  double sum = 0.0;
  for (int i = 0; i < depths; ++i) {
    const double z = depth(i, t);
    // Diffusion is wrong where the source is as near as a free path (the paper's kappa).
    const double trust = 1.0 - std::exp(-2.0 * t * (std::hypot(r, z) + z));
    sum += trust * albedo * albedo * dipole(r, z);
  }
  return sum / depths;
}

double BeamDiffusion::scattered_once(double r) const {
  const DiffusingMedium& m = medium_;
  const double t = m.extinction();
  // Shallower than this all light that gets to r is reflected back into the medium.
  const double shallowest = m.eta > 1.0 ? r * std::sqrt(m.eta * m.eta - 1.0) : 0.0;
  double sum = 0.0;
  for (int i = 0; i < depths; ++i) {
    const double z = shallowest + depth(i, t), way = std::hypot(r, z), cosine = z / way;
    const double leaves = 1.0 - static_cast<double>(fresnel_dielectric(static_cast<float>(-cosine),
                                                                       static_cast<float>(m.eta)));
    sum += m.scattering / t * std::exp(-t * (way + shallowest)) / (way * way) *
           henyey_greenstein(cosine, m.g) * leaves * cosine;
  }
  return sum / depths;
}

double BeamDiffusion::operator()(double r) const {
  if (!(medium_.scattering > 0.0)) return 0.0;
  return diffused(r) + scattered_once(r);
}

}  // namespace pssmlt
