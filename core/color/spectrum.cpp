#include "core/color/spectrum.h"

#include <algorithm>

#include "core/color/color_space.h"
#include "core/color/named_spectra.h"

namespace pssmlt {

double evaluate(const Samples& samples, double lambda, Outside outside) {
  if (samples.empty()) return 0.;
  const bool inside = lambda >= samples.front().x && lambda <= samples.back().x;
  if (!inside && outside == Outside::Zero) return 0.;
  const auto after = std::upper_bound(samples.begin(), samples.end(), lambda,
                                      [](double l, const vec2& s) { return l < s.x; });
  if (after == samples.begin()) return samples.front().y;
  if (after == samples.end()) return samples.back().y;
  const vec2& before = *(after - 1);
  const double t = (lambda - before.x) / (double(after->x) - before.x);
  return (1. - t) * before.y + t * after->y;
}

double planck(double lambda, double temperature) {
  constexpr double c = 299792458., h = 6.62607015e-34, k = 1.380649e-23;  // CODATA 2018
  const double l = lambda * 1e-9;
  return 2. * h * c * c / (std::pow(l, 5.) * std::expm1(h * c / (l * k * temperature)));
}

Samples blackbody_samples(double temperature) {
  constexpr double wien = 2.897771955e6;  // displacement law, [nm K]
  const double peak = planck(wien / temperature, temperature);
  Samples samples;
  for (int lambda = lambda_min; lambda <= lambda_max; lambda += 5)
    samples.emplace_back(float(lambda), float(planck(lambda, temperature) / peak));
  return samples;
}

dvec3 xyz_integral(const std::function<double(double)>& f) {
  dvec3 sum(0.);
  for (int lambda = lambda_min; lambda <= lambda_max; ++lambda) sum += f(lambda) * cie_1931(lambda);
  return sum;
}

dvec3 emission_xyz(const Samples& samples, Outside outside) {
  const dvec3 xyz = xyz_integral([&](double l) { return evaluate(samples, l, outside); });
  return xyz.y > 0. ? xyz / xyz.y : dvec3(0.);
}

dvec3 emission_rgb(const Samples& samples, Outside outside) {
  return rec709_from_xyz() * emission_xyz(samples, outside);
}

const dvec3& d65_white() {
  static const dvec3 white = emission_xyz(*named_spectrum("stdillum-D65"), Outside::Clamp);
  return white;
}

const std::vector<dvec3>& reflectance_weights() {
  static const std::vector<dvec3> weights = [] {
    const Samples d65 = *named_spectrum("stdillum-D65");
    std::vector<dvec3> w;
    dvec3 sum(0.);
    for (int lambda = lambda_min; lambda <= lambda_max; ++lambda) {
      w.push_back(rec709_from_xyz() * (evaluate(d65, lambda, Outside::Clamp) * cie_1931(lambda)));
      sum += w.back();
    }
    for (dvec3& weight : w) weight /= sum;
    return w;
  }();
  return weights;
}

dvec3 reflectance_rgb(const std::function<double(double)>& factor) {
  dvec3 sum(0.);
  double lambda = lambda_min;
  for (const dvec3& weight : reflectance_weights()) sum += factor(lambda++) * weight;
  return sum;
}

}  // namespace pssmlt
