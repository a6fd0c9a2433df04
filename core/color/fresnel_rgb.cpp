#include "core/color/fresnel_rgb.h"

#include "core/color/spectrum.h"

namespace pssmlt {

FresnelCurve FresnelCurve::from_spectra(const std::vector<vec2>& eta, const std::vector<vec2>& k,
                                        float outside) {
  std::vector<dvec2> index;  // (eta, k) at every wavelength of the weights
  for (int lambda = lambda_min; lambda <= lambda_max; ++lambda)
    index.emplace_back(evaluate(eta, lambda, Outside::Clamp) / outside,
                       evaluate(k, lambda, Outside::Clamp) / outside);
  const std::vector<dvec3>& weights = reflectance_weights();
  FresnelCurve curve;
  for (int i = 0; i <= intervals; ++i) {
    dvec3 sum(0.);
    for (size_t j = 0; j < weights.size(); ++j)
      sum += weights[j] * fresnel_conductor(double(cosine(i)), index[j].x, index[j].y);
    curve.table_[size_t(i)] = Rgb(glm::clamp(sum, 0., 1.));
  }
  curve.table_[0] = Rgb(1.f);
  return curve;
}

FresnelCurve FresnelCurve::from_rgb(const Rgb& eta, const Rgb& k, float outside) {
  FresnelCurve curve;
  for (int i = 0; i <= intervals; ++i)
    curve.table_[size_t(i)] =
        glm::clamp(fresnel_conductor(cosine(i), eta / outside, k / outside), 0.f, 1.f);
  curve.table_[0] = Rgb(1.f);
  return curve;
}

FresnelCurve FresnelCurve::from_reflectance(const Rgb& reflectance, float outside) {
  return from_rgb(Rgb(1.f), conductor_k_from_reflectance(reflectance), outside);
}

}  // namespace pssmlt
