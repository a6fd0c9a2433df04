// The range of exposures of HDR-FLIP and the tone curve that it looks through.
#include <algorithm>
#include <cmath>

#include "app/metrics/flip.h"

namespace pssmlt::flip {
namespace {

// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
constexpr double bright = 0.85;  // of the display's range
constexpr double beyond = 1e6;   // the curve has long reached 1

// Where the curve has the value t: the larger root.
double inverse_tone(double t) {
  const double half = 0.5 * (k1 - k4 * t) / (k0 - k3 * t), c = -k5 * t / (k0 - k3 * t);
  return -half + std::sqrt(half * half - c);
}

// Of values in any order: the middle one, or the mean of the two in the middle.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

float tone_mapped(double value) {
  const double x = std::clamp(value, 0.0, beyond);
  const double y = (k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5);
  return static_cast<float>(std::min(y, 1.0));
}

Exposures exposures_for(std::span<const Rgb> reference) {
  std::vector<double> luminances;
  luminances.reserve(reference.size());
  for (const Rgb& c : reference) {
    luminances.push_back(0.2126 * std::max(0.0, double(c.x)) + 0.7152 * std::max(0.0, double(c.y)) +
                         0.0722 * std::max(0.0, double(c.z)));
  }
  const double largest = luminances.empty() ? 0.0 : std::ranges::max(luminances);
  if (largest <= 0.0) return {};
  double middle = median(luminances);
  if (middle <= 0.0) {
    std::erase(luminances, 0.0);
    middle = median(luminances);
  }
  Exposures result;
  const double target = inverse_tone(bright);
  result.start = std::log2(target / largest);
  result.stop = std::log2(target / middle);
  result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
  return result;
}

}  // namespace pssmlt::flip
