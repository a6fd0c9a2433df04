#include "core/render/error_estimate.h"

#include <cmath>

namespace pssmlt {
namespace {

constexpr double normal_quantile = 1.959963984540054;  // 0.975

}  // namespace

double student_quantile(double n) {
  const double z = normal_quantile, z2 = z * z;
  const double g1 = z * (z2 + 1.0) / 4.0;
  const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 =
      z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

MeanEstimate estimate_mean(std::span<const GroupMean> groups) {
  MeanEstimate result;
  double weight = 0.0;
  for (const GroupMean& g : groups) {
    if (g.weight <= 0.0) continue;
    result.mean += g.weight * g.mean;
    weight += g.weight;
    ++result.groups;
  }
  if (result.groups == 0) return result;
  result.mean /= weight;
  if (result.groups < 2) return result;
  for (const GroupMean& g : groups) {
    if (g.weight <= 0.0) continue;
    const double d = g.weight / weight * (g.mean - result.mean);
    result.variance += d * d;
  }
  result.variance *= result.groups / (result.groups - 1.0);
  return result;
}

// Each cell's contribution is taken for the square of one normal number: a contribution c has then
// variance 2 E[c]^2, for which (2/3) c^2 is an unbiased estimate since E[c^2] = 3 E[c]^2. Cells
// that hold several independent errors make the interval wider than need be, never narrower.
void estimate_relative_mse(std::span<const double> cells, double count, double common,
                           ErrorEstimate& estimate) {
  double sum = 0.0, squares = 0.0;
  for (const double c : cells) {
    sum += c;
    squares += c * c;
  }
  estimate.relative_mse = sum / count + common;
  const double deviation = sum > 0.0 ? std::sqrt(2.0 / 3.0 * squares) / sum : 0.0;
  // The interval of a positive quantity: symmetric in its logarithm.
  const double factor = std::exp(normal_quantile * deviation);
  estimate.low = sum / count / factor + common;
  estimate.high = sum / count * factor + common;
  estimate.known = true;
}

}  // namespace pssmlt
