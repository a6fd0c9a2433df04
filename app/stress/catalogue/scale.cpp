// Group 1: the size of the scene, and where it lies.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

Point of_length(const std::string& value, double length, Oracle oracle) {
  return {value, [length] { return lab({.length = length}); }, std::move(oracle)};
}

Case powers_of_two() {
  Case c{.group = 1, .name = "scale-bits", .about = "all lengths times 2^k: the same bits"};
  for (const int k : {20, -20, 10, -10, 1, 0}) {
    c.points.push_back(of_length(fmt::format("2^{}", k), std::ldexp(1.0, k), SameBits{}));
  }
  return c;
}

Case powers_of_ten() {
  Case c{.group = 1, .name = "scale", .about = "all lengths times 10^k: the same picture"};
  for (const int k : {6, -6, 3, -3, 0}) {
    c.points.push_back(of_length(fmt::format("10^{}", k), std::pow(10.0, k), SameMeans{}));
  }
  return c;
}

// By a transformation the float grid does not matter: render space begins at the camera.
Case by_transform() {
  Case c{.group = 1, .name = "translation", .about = "Translate far away: the same picture"};
  for (const int k : {7, 5, 3, 0}) {
    const double d = k == 0 ? 0.0 : std::pow(10.0, k);
    const Lab l{.x = d, .y = -.7 * d, .z = 1.3 * d, .by_transform = true};
    c.points.push_back({fmt::format("10^{}", k), [l] { return lab(l); }, SameMeans{}});
  }
  return c;
}

// Coordinates that are written far away lie on the float grid, 2^-24 of their size: where that is
// too coarse for the shapes, loading says so.
Case by_coordinates() {
  Case c{.group = 1,
         .name = "coordinates",
         .about = "vertices far from the origin: the picture up to the float grid, or a warning"};
  const auto point = [](int k, Oracle oracle, std::vector<std::string> warnings) {
    const double d = k == 0 ? 0.0 : std::pow(10.0, k);
    const Lab l{.x = d, .y = -.7 * d, .z = 1.3 * d};
    return Point{fmt::format("10^{}", k),
                 [l] { return lab(l); },
                 std::move(oracle),
                 {},
                 std::move(warnings)};
  };
  const std::string coarse = "far from the origin";
  c.points = {point(7, AtMost{8.0}, {coarse}),
              point(6, AtMost{8.0}, {coarse}),
              point(5, SameMeans{.rounding = .05}, {coarse}),
              point(4, SameMeans{.rounding = 5e-3}, {}),
              point(3, SameMeans{.rounding = 5e-4}, {}),
              point(0, SameMeans{}, {})};
  return c;
}

}  // namespace

void add_scale_cases(Cases& cases) {
  cases.push_back(powers_of_two());
  cases.push_back(powers_of_ten());
  cases.push_back(by_transform());
  cases.push_back(by_coordinates());
}

}  // namespace pssmlt::stress
