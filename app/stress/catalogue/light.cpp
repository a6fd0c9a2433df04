// Group 3: how small lights are, and how many.
#include <cmath>
#include <numbers>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

const std::string plane =
    "Material \"diffuse\" \"rgb reflectance\" [ .6 .6 .6 ]\nShape \"disk\" \"float radius\" 3\n";

// Seen from below the light.
std::string below() { return plane_view(32, 1.0, 1.0, 0.0, .4); }

// A ball of radiance I / (pi r^2) sends what a point of intensity I sends, whatever its radius, as
// long as it is above the plane as a whole.
Case radius_sweep() {
  Case c{.group = 3,
         .name = "light-radius",
         .about = "radius of a ball that shines like a point light: I cos / d^2",
         .classes = "ADE",
         .max_depth = 1};
  for (const double radius : {1e-6, 1e-4, 1e-2, 1.0}) {
    const double radiance = 3.0 / (std::numbers::pi * radius * radius);
    const auto scene = [radius, radiance] {
      return below() + plane +
             fmt::format(
                 "AreaLightSource \"diffuse\" \"rgb L\" [ {0} {0} {0} ]\nTranslate 0 0 1.5\n"
                 "Shape \"sphere\" \"float radius\" {1}\n",
                 radiance, radius);
    };
    c.points.push_back({fmt::format("{}", radius), scene, Means{lit_quarters(1.0), 1e-3}});
  }
  return c;
}

std::string point_lamp(double intensity, double x, double y) {
  return fmt::format(
      "LightSource \"point\" \"rgb I\" [ {0} {0} {0} ] \"point3 from\" [ {1} {2} 1.5 "
      "]\n",
      intensity, x, y);
}

// Lights of one point light together, so close to each other that their places do not matter.
Case number_sweep() {
  Case c{.group = 3,
         .name = "light-number",
         .about = "point lights side by side that share 3 W/sr: I cos / d^2",
         .classes = "PDE",
         .max_depth = 1};
  for (const int side : {316, 32, 3, 1}) {
    const auto scene = [side] {
      std::string text = below() + plane;
      for (int i = 0; i < side * side; ++i) {
        text += point_lamp(3.0 / (side * side), 1e-3 * (i % side - .5 * (side - 1)) / side,
                           1e-3 * (i / side - .5 * (side - 1)) / side);
      }
      return text;
    };
    c.points.push_back({std::to_string(side * side), scene, Means{lit_quarters(1.0), 1e-3}});
  }
  return c;
}

// An area light without an area gives no light and takes none.
Case zero_area() {
  Case c{.group = 3,
         .name = "light-zero-area",
         .about = "area lights without an area beside a point light: they change nothing",
         .max_depth = 1};
  const std::string shine = "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\n";
  const std::string degenerate[] = {
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 1  0 0 1  0 0 1 ] \"integer indices\" [ 0 1 2 ]\n",
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 1  1 0 1  2 0 1 ] \"integer indices\" [ 0 1 2 "
      "]\n"};
  for (const int which : {0, 1}) {
    const std::string shape = degenerate[which];
    c.points.push_back(
        {which == 0 ? "point" : "line",
         [shine, shape] { return below() + plane + point_lamp(3.0, 0.0, 0.0) + shine + shape; },
         Means{lit_quarters(1.0), 1e-3},
         {},
         {},
         "PDE"});
  }
  c.polite = [] { return below() + plane + point_lamp(3.0, 0.0, 0.0); };
  return c;
}

}  // namespace

void add_light_cases(Cases& cases) {
  cases.push_back(radius_sweep());
  cases.push_back(number_sweep());
  cases.push_back(zero_area());
  Case few{.group = 3,
           .name = "few-bootstrap",
           .about = "a lamp that few bootstrap samples find: the error reads unknown, never small",
           .max_depth = 0};
  for (const double radius : {1e-3, 5e-3}) {
    few.points.push_back(
        {fmt::format("{}", radius), {}, Probe{[radius](const ProbeContext& context) {
           return few_contributing(context, radius);
         }}});
  }
  cases.push_back(std::move(few));
}

}  // namespace pssmlt::stress
