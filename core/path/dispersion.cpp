#include "core/path/dispersion.h"

#include <algorithm>
#include <vector>

#include "core/color/spectrum.h"
#include "core/sampling/primary_sample.h"

namespace pssmlt {
namespace {

// By nanometre of the visible range.
struct Visible {
  std::vector<Rgb> colours;       // over the density
  std::vector<double> cumulated;  // from 0 to 1, one more than colours
};

Visible tabulate() {
  std::vector<dvec3> weights = reflectance_weights();
  dvec3 sum(0.0);
  for (dvec3& w : weights) {
    w = glm::max(w, dvec3(0.0));
    sum += w;
  }
  Visible v;
  v.cumulated.push_back(0.0);
  for (dvec3 w : weights) {
    w /= sum;
    const double density = (w.x + w.y + w.z) / 3.0;
    v.colours.push_back(density > 0.0 ? Rgb(w / density) : Rgb(0.f));
    v.cumulated.push_back(v.cumulated.back() + density);
  }
  return v;
}

}  // namespace

Wavelength draw_wavelength(float u) {
  static const Visible visible = tabulate();
  const double x = static_cast<double>(u) * visible.cumulated.back();
  const auto above = std::upper_bound(visible.cumulated.begin(), visible.cumulated.end(), x);
  const auto last = static_cast<std::ptrdiff_t>(visible.colours.size()) - 1;
  const auto i = static_cast<size_t>(
      std::clamp<std::ptrdiff_t>(std::distance(visible.cumulated.begin(), above) - 1, 0, last));
  const double low = visible.cumulated[i], width = visible.cumulated[i + 1] - low;
  const double part = width > 0.0 ? (x - low) / width : 0.5;
  // The weight of a nanometre is that of the wavelengths around it.
  const double lambda = lambda_min + static_cast<double>(i) + std::min(part, 1.0) - 0.5;
  return {static_cast<float>(lambda), visible.colours[i]};
}

Wavelength path_wavelength(PrimarySample& u) {
  return draw_wavelength(u.numbers(Stream::shared, 0, 1).next());
}

}  // namespace pssmlt
