// Group 2: how bright it is.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

Case powers_of_two() {
  Case c{.group = 2, .name = "radiance-bits", .about = "all light times 2^k: the picture is, too"};
  for (const int k : {100, -100, 60, -60, 20, -20, 0}) {
    const double radiance = std::ldexp(1.0, k);
    c.points.push_back({fmt::format("2^{}", k), [radiance] { return lab({.radiance = radiance}); },
                        SameBits{radiance}});
  }
  return c;
}

// A lamp of the given intensity in a closed box that nothing looks into, beside one of 3 W/sr.
std::string hidden_lamp(double intensity) {
  return plane_view(32, 1.0, 1.0) + fmt::format(R"(
LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 0 0 1.5 ]
LightSource "point" "rgb I" [ {0} {0} {0} ] "point3 from" [ 5 0 .5 ]
Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
Shape "disk" "float radius" 2
Translate 5 0 .5
Shape "sphere" "float radius" .3)",
                                                intensity);
}

Case unequal_lights() {
  Case c{.group = 2,
         .name = "unequal-lights",
         .about = "a hidden lamp 10^12 times the one that is seen: I cos / d^2 of that one",
         .classes = "PDE",
         .max_depth = 1};
  for (const int k : {12, 6, 3, 0}) {
    const double intensity = 3.0 * std::pow(10.0, k);
    c.points.push_back({fmt::format("10^{}", k), [intensity] { return hidden_lamp(intensity); },
                        Means{lit_quarters(1.0)}});
  }
  return c;
}

}  // namespace

void add_radiometric_cases(Cases& cases) {
  cases.push_back(powers_of_two());
  cases.push_back(unequal_lights());
}

}  // namespace pssmlt::stress
