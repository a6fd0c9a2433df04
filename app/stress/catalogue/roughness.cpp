// Group 4: from rough to smooth.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

// Around Ggx::smooth_below, where the code switches, and the whole range.
constexpr double widths[] = {1e-6, 9.9e-4, 1.01e-3, 1.5e-3, 1e-2, .1, .5, 1.0, 0.0};

// Rough, but so little that points drawn on the light or on the lens rarely hit the lobe.
bool is_narrow(double alpha) { return alpha > 1e-3 && alpha < .3; }

std::string roughness(double alpha) {
  return fmt::format(" \"bool remaproughness\" false \"float roughness\" {}", alpha);
}

// Metal that reflects everything, in a sky of radiance 1. Facets that scatter once lose at most
// what they shadow: of the order of the width at this angle, squared.
Case metal_furnace(double tilt) {
  Case c{.group = 4,
         .name = fmt::format("metal-furnace-{:.0f}", tilt),
         .about = "roughness of a white metal in a white sky: at most 1, and 1 when smooth",
         .classes = "I.*E",
         .max_depth = 1,
         .demand = .06};
  for (const double alpha : widths) {
    const auto scene = [alpha, tilt] {
      return plane_view(16, .7, .7, tilt) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "conductor" "rgb reflectance" [ 1 1 1 ])" +
             roughness(alpha) + "\nShape \"disk\" \"float radius\" 1";
    };
    const Oracle oracle = alpha <= .01 ? Oracle(Means{{1.0}, 2e-3}) : Oracle(AtMost{1.0});
    c.points.push_back({.value = fmt::format("{}", alpha),
                        .scene = scene,
                        .oracle = oracle,
                        .narrow = is_narrow(alpha)});
  }
  return c;
}

// A ball of glass in a white sky is not seen, whatever its roughness, but for what facets that
// scatter once lose.
Case glass_furnace() {
  Case c{.group = 4,
         .name = "glass-furnace",
         .about = "roughness of glass in a white sky: at most 1, and 1 when smooth",
         .classes = "I.*E",
         .max_depth = 40,
         .demand = .06};
  for (const double alpha : widths) {
    const auto scene = [alpha] {
      return plane_view(16, .7, .7) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "dielectric" "float eta" 1.5)" +
             roughness(alpha) + "\nShape \"sphere\" \"float radius\" 1";
    };
    const Oracle oracle = alpha <= 2e-3 ? Oracle(Means{{1.0}, 3e-3}) : Oracle(AtMost{1.0});
    c.points.push_back({.value = fmt::format("{}", alpha),
                        .scene = scene,
                        .oracle = oracle,
                        .narrow = is_narrow(alpha)});
  }
  return c;
}

// The room's ball is replaced by one whose roughness goes to zero: the picture goes to the smooth
// one's, without a step at the width where the code switches.
Case to_smooth(const std::string& name, const std::string& material) {
  Case c{.group = 4,
         .name = name,
         .about = "roughness around the switch to smooth: the picture of the smooth material",
         .classes = "(A|I).*E",
         .max_depth = 4};
  for (const double alpha : {1e-6, 9.9e-4, 1.01e-3, 1.5e-3, 0.0}) {
    const auto scene = [alpha, material] {
      return film(16, 16) + R"(
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 30
WorldBegin
LightSource "infinite" "rgb L" [ .3 .3 .3 ]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 2 2 2 ]
Shape "bilinearmesh" "point3 P" [ -2 3 -2  2 3 -2  -2 3 2  2 3 2 ]
AttributeEnd
AttributeBegin
Translate 0 .9 0
)" + material +
             roughness(alpha) +
             R"(
Shape "sphere" "float radius" .7
AttributeEnd
Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]
Shape "bilinearmesh" "point3 P" [ -2 0 -2  2 0 -2  -2 0 2  2 0 2 ])";
    };
    c.points.push_back({.value = fmt::format("{}", alpha),
                        .scene = scene,
                        .oracle = SameMeans{.rounding = .01},
                        .narrow = is_narrow(alpha)});
  }
  return c;
}

}  // namespace

void add_roughness_cases(Cases& cases) {
  cases.push_back(metal_furnace(0.0));
  cases.push_back(metal_furnace(60.0));
  cases.push_back(glass_furnace());
  cases.push_back(
      to_smooth("metal-to-smooth", "Material \"conductor\" \"rgb reflectance\" [ .9 .8 .7 ]"));
  cases.push_back(to_smooth("glass-to-smooth", "Material \"dielectric\" \"float eta\" 1.5"));
  Case pdf{.group = 4,
           .name = "density-integral",
           .about = "roughness: the density of directions integrates to what is drawn",
           .over = Over::once};
  for (const double alpha : {1.01e-3, 2e-3, 1e-2, .1, .5, 1.0}) {
    pdf.points.push_back({fmt::format("{}", alpha), {}, Probe{[alpha](const ProbeContext&) {
                            return integrate_density(alpha);
                          }}});
  }
  cases.push_back(std::move(pdf));
}

}  // namespace pssmlt::stress
