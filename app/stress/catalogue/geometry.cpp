// Group 8: awkward geometry.
#include <cmath>
#include <numbers>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

constexpr double albedo = .5;
constexpr int depth = 8;

// In any closed room whose walls shine and reflect the same everywhere the radiance is the same
// everywhere, whatever the walls are made of: 1 + rho + ... + rho^d. A gap lets darkness in, a wall
// that shadows itself takes light away.
double enclosure_radiance() { return (1.0 - std::pow(albedo, depth + 1)) / (1.0 - albedo); }

std::string inside(const std::string& walls) {
  return film(16, 16) + R"(
LookAt .3 -.2 .1  -.4 .1 1  0 1 0
Camera "perspective" "float fov" 70
WorldBegin
ReverseOrientation
Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
)" + walls;
}

const std::string ball = "Shape \"sphere\" \"float radius\" 1\n";

using Values = std::vector<std::pair<std::string, std::string>>;

Case enclosure(const std::string& name, const std::string& about, const Values& walls,
               double rounding = 1e-3) {
  Case c{.group = 8, .name = name, .about = about, .classes = "AD*E", .max_depth = depth};
  c.polite = [] { return inside(ball); };
  for (const auto& [value, text] : walls) {
    c.points.push_back(
        {value, [text = text] { return inside(text); }, Means{{enclosure_radiance()}, rounding}});
  }
  return c;
}

// A cube from -1 to 1 whose faces are cut at `cuts` along the first of their axes: strips from edge
// to edge, normals outside.
std::string cut_cube(const std::vector<double>& cuts) {
  std::string points, indices;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        for (const auto& [u, v] : {std::pair(cuts[k], -1.0), std::pair(cuts[k + 1], -1.0),
                                   std::pair(cuts[k + 1], 1.0), std::pair(cuts[k], 1.0)}) {
          double p[3];
          p[axis] = side;
          p[(axis + 1) % 3] = u;
          p[(axis + 2) % 3] = v;
          points += fmt::format("{} {} {} ", p[0], p[1], p[2]);
        }
        const char* const order =
            side > 0.0 ? "{0} {1} {2} {0} {2} {3} " : "{0} {2} {1} {0} {3} {2} ";
        indices += fmt::format(fmt::runtime(order), count, count + 1, count + 2, count + 3);
        count += 4;
      }
    }
  }
  return "Shape \"trianglemesh\" \"point3 P\" [ " + points + "] \"integer indices\" [ " + indices +
         "]\n";
}

// A ball of triangles: `slices` around the axis meet in each pole.
std::string fan_ball(int slices) {
  constexpr int rings = 16;
  std::string points = "0 0 -1 0 0 1 ", indices;
  for (int r = 1; r < rings; ++r) {
    for (int s = 0; s < slices; ++s) {
      const double theta = std::numbers::pi * r / rings, phi = 2.0 * std::numbers::pi * s / slices;
      points += fmt::format("{} {} {} ", std::sin(theta) * std::cos(phi),
                            std::sin(theta) * std::sin(phi), -std::cos(theta));
    }
  }
  const auto at = [slices](int r, int s) { return 2 + (r - 1) * slices + s % slices; };
  for (int s = 0; s < slices; ++s) {
    indices += fmt::format("0 {} {} 1 {} {} ", at(1, s + 1), at(1, s), at(rings - 1, s),
                           at(rings - 1, s + 1));
    for (int r = 1; r + 1 < rings; ++r) {
      indices += fmt::format("{0} {1} {2} {0} {2} {3} ", at(r, s), at(r, s + 1), at(r + 1, s + 1),
                             at(r + 1, s));
    }
  }
  return "Shape \"trianglemesh\" \"point3 P\" [ " + points + "] \"integer indices\" [ " + indices +
         "]\n";
}

std::string cylinder_room(double phi) {
  return fmt::format(R"(
Shape "cylinder" "float radius" 1 "float zmin" -1 "float zmax" 1 "float phimax" {0}
Shape "disk" "float radius" 1 "float height" 1 "float phimax" {0}
ReverseOrientation
Shape "disk" "float radius" 1 "float height" -1 "float phimax" {0}
)",
                     phi);
}

std::string instance(const std::string& scale, double radius) {
  return fmt::format(
      "ObjectBegin \"ball\"\nShape \"sphere\" \"float radius\" {}\nObjectEnd\n{}\n"
      "ObjectInstance \"ball\"\n",
      radius, scale);
}

// White surfaces in a white sky: nothing is brighter than the sky, and where the surface is flat,
// nothing darker.
Case furnace(const std::string& name, const std::string& about, const Values& shapes,
             const std::function<std::string()>& view, const Oracle& oracle) {
  Case c{.group = 8, .name = name, .about = about, .classes = "IDE", .max_depth = 1};
  c.polite = [] {
    return plane_view(16, .7, .7) +
           "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\nMaterial "
           "\"diffuse\" \"rgb reflectance\" [ 1 1 1 ]\nShape \"disk\" \"float radius\" 2\n";
  };
  for (const auto& [value, text] : shapes) {
    c.points.push_back({value,
                        [view, text = text] {
                          return view() +
                                 "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\nMaterial "
                                 "\"diffuse\" \"rgb reflectance\" [ 1 1 1 ]\n" +
                                 text;
                        },
                        oracle});
  }
  return c;
}

// A square whose normals are bent by the angle, all the same way.
std::string bent_square(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  std::string normals;
  for (int i = 0; i < 4; ++i) normals += fmt::format("{} 0 {} ", std::sin(a), std::cos(a));
  return "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] \"integer "
         "indices\" [ 0 1 2 0 2 3 ] \"normal N\" [ " +
         normals + "]\n";
}

// A book: pages below the plane that share an edge along y.
std::string book(int pages) {
  std::string points = "0 -1 0  0 1 0 ", indices;
  for (int i = 0; i < pages; ++i) {
    const double a = std::numbers::pi * (i + .5) / pages;
    points += fmt::format("{} 0 {} ", std::cos(a), -std::sin(a));
    indices += fmt::format("0 1 {} ", i + 2);
  }
  return "Shape \"trianglemesh\" \"point3 P\" [ " + points + "] \"integer indices\" [ " + indices +
         "]\n";
}

std::string square_of(double half) {
  return fmt::format(
      "Shape \"bilinearmesh\" \"point3 P\" [ -{0} -{0} 0  {0} -{0} 0  -{0} {0} 0  "
      "{0} {0} 0 ]\n",
      half);
}

// Scenes that must not load.
Case refused() {
  Case c{.group = 8, .name = "refused-geometry", .about = "vertices that are no numbers: refused"};
  const auto point = [](const std::string& value, const std::string& shape,
                        const std::string& message) {
    return Point{value, [shape] { return inside(shape); }, Refused{message}};
  };
  const std::string mesh = "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point3 P\" ";
  c.points = {point("nan", mesh + "[ 0 0 nan  1 0 0  0 1 0 ]", "stress-scene:10:"),
              point("inf", mesh + "[ 0 0 inf  1 0 0  0 1 0 ]", "stress-scene:10:"),
              point("1e39", mesh + "[ 0 0 1e39  1 0 0  0 1 0 ]", "stress-scene:10:"),
              point("2 of 3", mesh + "[ 0 0 0  1 0 0 ]", "stress-scene:10:"),
              point("radius 0", "Shape \"sphere\" \"float radius\" 0", "stress-scene:10:"),
              point("scale 0", "Scale 1 1 0 " + ball, "stress-scene:10:")};
  c.over = Over::once;
  return c;
}

// A plane far larger than what is seen of it, under a point light.
Case ground() {
  Case c{.group = 8,
         .name = "ground",
         .about = "half width of a plane under a point light: I cos / d^2",
         .classes = "PDE",
         .max_depth = 1};
  for (const double half : {1e7, 1e3, 2.0}) {
    c.points.push_back({fmt::format("{}", half),
                        [half] {
                          return plane_view(32, 1.0, 1.0) + R"(
LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 0 0 1.5 ]
Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
)" + square_of(half);
                        },
                        Means{lit_quarters(1.0), 1e-3}});
  }
  return c;
}

std::function<std::string()> view(double half, double distance = 10.0) {
  return [half, distance] { return plane_view(16, half, half, 0.0, distance); };
}

void add_enclosures(Cases& cases) {
  cases.push_back(enclosure("slivers", "aspect of strips in the walls of a room: closed form",
                            {{"1e8", cut_cube({-1.0, 0.0, 2e-8, 1.0})},
                             {"1e4", cut_cube({-1.0, 0.0, 2e-4, 1.0})},
                             {"1", cut_cube({-1.0, 1.0})}}));
  cases.push_back(
      enclosure("fans", "triangles that share a vertex, in a ball: closed form",
                {{"10000", fan_ball(10000)}, {"100", fan_ball(100)}, {"8", fan_ball(8)}}));
  cases.push_back(enclosure("zero-triangles", "triangles without area in the room: closed form",
                            {{"mixed", ball + "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  "
                                              "0 1 0 ] \"integer indices\" [ 0 0 1  0 1 1 ]\n"},
                             {"none", ball}}));
  cases.push_back(enclosure("instances", "scale of an instanced room: closed form",
                            {{"1e-5", instance("Scale 1e-5 1e-5 1e-5", 1e5)},
                             {"-1", instance("Scale -1 1 1", 1.0)},
                             {"1e5", instance("Scale 1e5 1e5 1e5", 1e-5)},
                             {"1", instance("", 1.0)}}));
  cases.push_back(enclosure("quadric-room", "sweep of a cylinder with lids: closed form",
                            {{"359.9999", cylinder_room(359.9999)}, {"360", cylinder_room(360)}}));
}

}  // namespace

void add_geometry_cases(Cases& cases) {
  add_enclosures(cases);
  cases.push_back(refused());
  const Oracle one = Means{{1.0}, 1e-3};
  cases.push_back(ground());
  cases.push_back(furnace("coincident", "white triangles at one place, in a white sky: 1",
                          {{"10",
                            [] {
                              std::string text;
                              for (int i = 0; i < 10; ++i) text += square_of(2);
                              return text;
                            }()},
                           {"1", square_of(2)}},
                          view(.7), one));
  cases.push_back(furnace("far-ball", "distance of a white ball [radii] in a white sky: 1",
                          {{"1e6", ball}}, view(.5, 1e6), one));
  cases.push_back(furnace("far-ball-near", "the same nearer", {{"1e3", ball}}, view(.5, 1e3), one));
  cases.push_back(furnace("bent-normals", "degrees between normals, in a white sky: at most 1",
                          {{"90", bent_square(90.0)},
                           {"89.999", bent_square(89.999)},
                           {"60", bent_square(60.0)},
                           {"0", bent_square(0.0)}},
                          view(.7), AtMost{1.0}));
  cases.push_back(furnace("pages", "triangles that share an edge, in a white sky: at most 1",
                          {{"10000", book(10000)}, {"100", book(100)}, {"2", book(2)}}, view(.5),
                          AtMost{1.0}));
}

}  // namespace pssmlt::stress
