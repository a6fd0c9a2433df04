// Group 6: white walls and long paths.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

// A sphere that shines and reflects inside: 1 (1 - rho^(d+1)) / (1 - rho) everywhere.
std::string integrating_sphere(int size, double rho) {
  return film(size, size) + fmt::format(R"(
LookAt .3 -.2 .1  -.4 .1 1  0 1 0
Camera "perspective" "float fov" 60
WorldBegin
ReverseOrientation
Material "diffuse" "rgb reflectance" [ {0} {0} {0} ]
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "sphere" "float radius" 1)",
                                        rho);
}

double radiance(double rho, int depth) {
  return -std::expm1((depth + 1) * std::log(rho)) / (1.0 - rho);
}

// Albedos are floats in the renderer.
double as_float(double rho) { return static_cast<double>(static_cast<float>(rho)); }

Case sphere(const std::string& name, int size, int depth, std::vector<double> albedos,
            const std::string& about, double demand = .1) {
  Case c{.group = 6,
         .name = name,
         .about = about,
         .classes = "AD*E",
         .max_depth = depth,
         .demand = demand};
  c.polite = [size] { return integrating_sphere(size, .5); };
  for (const double rho : albedos) {
    c.points.push_back({fmt::format("{}", rho),
                        [size, rho] { return integrating_sphere(size, rho); },
                        Means{{radiance(as_float(rho), depth)}, 1e-3}});
  }
  return c;
}

}  // namespace

void add_albedo_cases(Cases& cases) {
  const std::string form = "albedo of a sphere, closed form: ";
  cases.push_back(sphere("white-sphere-1", 16, 1, {.999, .9}, form + "one bounce"));
  cases.push_back(sphere("white-sphere-2", 16, 2, {.999, .9}, form + "two bounces"));
  cases.push_back(sphere("white-sphere-1000", 8, 1000, {.999, .99}, form + "1000 bounces"));
  cases.push_back(sphere("white-sphere", 8, 1000000, {.999, .99, .9}, form + "no limit", .2));
  // Paths are ten thousand bounces long, and a hundred thousand: few of them can be asked for, and
  // the latter only of those who have time, so that it does not come first.
  Case million =
      sphere("white-sphere-million", 2, 1000000, {.9999, .99999}, form + "a million bounces", 1.0);
  million.bootstrap = 256;
  cases.push_back(std::move(million));
}

}  // namespace pssmlt::stress
