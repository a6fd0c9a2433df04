// Group 5: indices of refraction, angles, bodies that touch.
#include <cmath>
#include <numbers>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

constexpr int bounces = 12;

const std::string sky = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";

// Two boundaries, seen from above.
std::string slab(double eta, double tilt) {
  return plane_view(8, .4, .4, tilt) + sky +
         fmt::format("Material \"dielectric\" \"float eta\" {}\n", eta) + R"(
Shape "disk" "float radius" 20
ReverseOrientation
Shape "disk" "float radius" 20 "float height" -.5)";
}

// A slab in a white sky shows R + T^2 (1 + R + R^2 + ...), cut after `bounces` boundaries.
double slab_radiance(double eta, double tilt) {
  const double r = fresnel_reflectance(std::cos(tilt * std::numbers::pi / 180.0), eta);
  double sum = r;
  for (int k = 0; k + 2 <= bounces; ++k) sum += (1.0 - r) * (1.0 - r) * std::pow(r, k);
  return sum;
}

Case index_sweep() {
  Case c{.group = 5,
         .name = "slab-index",
         .about = "relative index of a slab in a white sky, seen at 45 degrees: closed form",
         .classes = "IS*E",
         .max_depth = bounces,
         .demand = .02};
  for (const double eta : {1.000001, .999999, 10.0, .1, 1.0, 3.0, .5, 1.5}) {
    c.points.push_back({fmt::format("{}", eta), [eta] { return slab(eta, 45.0); },
                        Means{{slab_radiance(eta, 45.0)}, 1e-3}});
  }
  return c;
}

// 89.974 degrees: the sine is 1 - 10^-7.
Case angle_sweep() {
  Case c{.group = 5,
         .name = "slab-angle",
         .about = "angle of sight [degrees] at a slab in a white sky: closed form",
         .classes = "IS*E",
         .max_depth = bounces,
         .demand = .02};
  for (const double tilt : {89.974377, 89.9, 89.0, 80.0, 45.0, 0.0}) {
    c.points.push_back({fmt::format("{}", tilt), [tilt] { return slab(1.5, tilt); },
                        Means{{slab_radiance(1.5, tilt)}, 1e-3}});
  }
  return c;
}

// From inside of glass, radiance gains by the squared index what it loses on the way in.
Case critical_angle() {
  Case c{.group = 5,
         .name = "critical-angle",
         .about = "angle of sight [critical angles] from inside of glass: Fresnel's formulas",
         .classes = "IS*E",
         .max_depth = 1,
         .demand = .02};
  const double critical = std::asin(1.0 / 1.5) * 180.0 / std::numbers::pi;
  for (const double part : {1.0, 1.0 + 1e-7, 1.0 - 1e-7, 1.0 + 1e-4, 1.0 - 1e-4, 1.1, .9}) {
    const double tilt = part * critical;
    const double r = fresnel_reflectance(std::cos(tilt * std::numbers::pi / 180.0), 1.0 / 1.5);
    const auto scene = [tilt] {
      return plane_view(8, .4, .4, tilt) + sky +
             "Material \"dielectric\" \"float eta\" 1.5\nReverseOrientation\n"
             "Shape \"disk\" \"float radius\" 20";
    };
    // The angle's own rounding moves R by the root of it at the critical angle.
    const double rounding = std::abs(part - 1.0) < 1e-3 ? 5e-3 : 1e-3;
    c.points.push_back(
        {fmt::format("{:.7f}", part), scene, Means{{r + (1.0 - r) * 1.5 * 1.5}, rounding}});
  }
  return c;
}

// resolved: floats can tell its surfaces apart at the camera's distance; else loading warns.
struct Body {
  std::string value, text;
  bool resolved = true;
};

// Bodies without absorption in a white sky are not seen. 60 boundaries leave less than 10^-3.
Case bodies(const std::string& name, const std::string& about, const std::vector<Body>& scenes) {
  Case c{
      .group = 5, .name = name, .about = about, .classes = "IS*E", .max_depth = 60, .demand = .03};
  for (const Body& body : scenes) {
    Point point{.value = body.value,
                .scene = [text = body.text] { return plane_view(16, .9, .9, 20.0) + sky + text; },
                .oracle = Means{{1.0}, 2e-3}};
    if (!body.resolved) {  // never more than light inside of glass has
      point.oracle = AtMost{1.5 * 1.5};
      point.warnings = {"lie so close to each other"};
    }
    c.points.push_back(std::move(point));
  }
  return c;
}

const std::string glass = "Material \"dielectric\" \"float eta\" 1.5\n";
const std::string ball = "Shape \"sphere\" \"float radius\" .6\n";

std::string nested(double inner) {
  return glass + ball +
         fmt::format(
             "Material \"dielectric\" \"float eta\" .8867\n"
             "Shape \"sphere\" \"float radius\" {}\n",
             inner);
}

std::string touching_balls(double gap) {
  return glass + "Shape \"sphere\" \"float radius\" .3\n" +
         fmt::format("Translate {} 0 0\nShape \"sphere\" \"float radius\" .3\n", .6 + gap);
}

// Two slabs, one upon the other, `gap` apart.
std::string stacked(double gap) {
  return glass + fmt::format(R"(
Shape "disk" "float radius" 20 "float height" .5
ReverseOrientation
Shape "disk" "float radius" 20 "float height" 0
ReverseOrientation
Shape "disk" "float radius" 20 "float height" {}
ReverseOrientation
Shape "disk" "float radius" 20 "float height" -.5
)",
                             -gap);
}

}  // namespace

void add_refraction_cases(Cases& cases) {
  cases.push_back(index_sweep());
  cases.push_back(angle_sweep());
  cases.push_back(critical_angle());
  cases.push_back(bodies(
      "nested-glass", "radius of water in glass of radius .6: energy",
      {{".5999999", nested(.5999999), false}, {".5999", nested(.5999)}, {".3", nested(.3)}}));
  cases.push_back(bodies("touching-glass", "gap between two balls of glass: energy",
                         {{"0", touching_balls(0.0)},
                          {"1e-7", touching_balls(1e-7)},
                          {"1e-4", touching_balls(1e-4)},
                          {".1", touching_balls(.1)}}));
  cases.push_back(bodies("stacked-glass", "gap between two slabs of glass: energy",
                         {{"0", stacked(0.0), false},
                          {"1e-6", stacked(1e-6), false},
                          {"1e-3", stacked(1e-3)},
                          {".1", stacked(.1)}}));
}

}  // namespace pssmlt::stress
