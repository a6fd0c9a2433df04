#include "app/metrics/flip_kernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pssmlt::flip {
namespace {

constexpr double edge_width = 0.082;  // of the eye's edge filter, peak to trough [degrees]

double square(double x) { return x * x; }

template <typename Function>
std::vector<double> tabulate(int radius, const Function& f) {
  std::vector<double> values;
  for (int k = -radius; k <= radius; ++k) values.push_back(f(static_cast<double>(k)));
  return values;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum;
}

// Outer weights that no float sum would notice are left out.
Kernel to_kernel(const std::vector<double>& values, double factor) {
  constexpr double unnoticed = 1e-9;
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  size_t skip = 0;
  while (skip < values.size() / 2 && std::abs(values[skip]) < unnoticed * largest &&
         std::abs(values[values.size() - 1 - skip]) < unnoticed * largest) {
    ++skip;
  }
  Kernel kernel;
  for (size_t k = skip; k < values.size() - skip; ++k) {
    kernel.push_back(static_cast<float>(values[k] * factor));
  }
  return kernel;
}

// Positive weights scaled to sum 1, negative ones to -1.
Kernel balanced(std::vector<double> values) {
  double positive = 0.0, negative = 0.0;
  for (const double v : values) (v > 0.0 ? positive : negative) += std::abs(v);
  for (double& v : values) v /= v > 0.0 ? positive : negative;
  return to_kernel(values, 1.0);
}

}  // namespace

int filter_radius(double pixels_per_degree) {
  const double widest = std::max({achromatic.b1, red_green.b1, blue_yellow.b1});
  const double deviation = std::sqrt(widest / (2.0 * square(std::numbers::pi)));  // [degrees]
  return static_cast<int>(std::ceil(3.0 * deviation * pixels_per_degree));
}

std::vector<GaussianTerm> gaussian_terms(const Sensitivity& s, double pixels_per_degree) {
  const int radius = filter_radius(pixels_per_degree);
  struct Term {
    std::vector<double> values;
    double weight;  // of values x values
  };
  std::vector<Term> terms;
  double total = 0.0;
  const auto add = [&](double a, double b) {
    if (a == 0.0) return;
    const auto bell = [&](double k) {
      return std::exp(-square(std::numbers::pi * k / pixels_per_degree) / b);
    };
    terms.push_back({tabulate(radius, bell), a * std::sqrt(std::numbers::pi / b)});
    total += terms.back().weight * square(sum_of(terms.back().values));
  };
  add(s.a1, s.b1);
  add(s.a2, s.b2);
  std::vector<GaussianTerm> result;
  for (const Term& t : terms) {
    result.push_back({to_kernel(t.values, t.weight / total), to_kernel(t.values, 1.0)});
  }
  return result;
}

Detectors::Detectors(double pixels_per_degree) {
  const double deviation = 0.5 * edge_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto bell = [&](double x) { return std::exp(-square(x / deviation) / 2.0); };
  const std::vector<double> g = tabulate(radius, bell);
  gaussian = to_kernel(g, 1.0 / sum_of(g));
  edge = balanced(tabulate(radius, [&](double x) { return -x * bell(x); }));
  point =
      balanced(tabulate(radius, [&](double x) { return (square(x / deviation) - 1.0) * bell(x); }));
}

}  // namespace pssmlt::flip
