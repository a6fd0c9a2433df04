#include <cmath>
#include <random>
#include <vector>

#include "tests/app/report/sample_data.h"

namespace pssmlt::sample {
namespace {

struct Colour {
  double r, g, b;
};

// A floor, a wall, a bright lamp and a ring of light, which is what some techniques are blind to.
Colour scene_at(double x, double y, int scene) {
  const double horizon = 0.55, phase = 0.7 * scene;
  Colour c = y < horizon ? Colour{0.35, 0.3, 0.26} : Colour{0.5, 0.47, 0.4};
  const bool tile = (std::lround(std::floor(x * 8 + phase)) + std::lround(std::floor(y * 10))) % 2;
  const double shade = y < horizon ? 0.25 + 0.5 * y : (tile ? 0.9 : 0.45);
  const double ball = std::hypot((x - 0.3 - 0.05 * scene) * 1.7, y - 0.6);
  if (ball < 0.16) c = {0.7, 0.15 + 0.1 * scene, 0.1};
  c = {c.r * shade, c.g * shade, c.b * shade};
  const double ring = std::exp(-std::pow((std::hypot((x - 0.68) * 1.7, y - 0.74) - 0.1) / 0.02, 2));
  const double lamp = std::hypot((x - 0.75) * 1.7, y - 0.12) < 0.06 ? 12.0 : 0.0;
  return {c.r + 2.5 * ring + lamp, c.g + 1.9 * ring + lamp, c.b + 1.1 * ring + 0.8 * lamp};
}

double near_ring(double x, double y) {
  return std::exp(-std::pow((std::hypot((x - 0.68) * 1.7, y - 0.74) - 0.1) / 0.05, 2));
}

}  // namespace

std::vector<float> Pictures::render(int technique, double seconds) const {
  std::vector<float> rgb;
  rgb.reserve(3 * static_cast<size_t>(width_) * static_cast<size_t>(height_));
  const unsigned moment = std::isfinite(seconds) ? static_cast<unsigned>(seconds * 100) : 0;
  std::mt19937 random(static_cast<unsigned>(1000 * technique + 10 * scene_ + 1) + moment);
  std::normal_distribution<double> normal;
  std::vector<double> blotch(static_cast<size_t>(width_ / 6 + 2), 0.0);
  const bool chains = technique % 3 == 2;
  for (int row = 0; row < height_; ++row) {
    if (row % 6 == 0) {
      for (double& b : blotch) b = normal(random);
    }
    for (int column = 0; column < width_; ++column) {
      const double x = (column + 0.5) / width_, y = (row + 0.5) / height_;
      const Colour c = scene_at(x, y, scene_);
      double factor = 1.0, tint = 0.0;
      if (std::isfinite(seconds)) {
        const double hard = technique % 3 == 0 ? 6.0 : technique % 3 == 1 ? 1.5 : 0.5;
        const double sigma = (0.35 + hard * near_ring(x, y)) / std::sqrt(seconds);
        const double noise = 0.4 * normal(random) +
                             (chains ? blotch[static_cast<size_t>(column / 6)] : normal(random));
        // Log-normal with mean 1.
        const double s = std::sqrt(std::log1p(sigma * sigma));
        factor = std::exp(s * noise - s * s / 2);
        tint = 0.15 * s * normal(random);
      }
      rgb.push_back(static_cast<float>(c.r * factor * std::exp(tint)));
      rgb.push_back(static_cast<float>(c.g * factor));
      rgb.push_back(static_cast<float>(c.b * factor * std::exp(-tint)));
    }
  }
  return rgb;
}

}  // namespace pssmlt::sample
