// Group 7: media from thin to thick.
#include <cmath>
#include <numbers>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

std::string homogeneous(double absorption, double scattering, double g = 0.0) {
  return fmt::format(
      "\"string type\" \"homogeneous\" \"rgb sigma_a\" [ {0} {0} {0} ] \"rgb "
      "sigma_s\" [ {1} {1} {1} ] \"float g\" {2}",
      absorption, scattering, g);
}

// A slab from z = -thickness to 0 between disks that cannot be seen.
std::string slab(const std::string& medium, double thickness, double radius) {
  return fmt::format(R"(
MakeNamedMedium "slab" {0}
AttributeBegin
Material "interface"
MediumInterface "slab" ""
Shape "disk" "float radius" {1}
ReverseOrientation
Shape "disk" "float radius" {1} "float height" {2}
AttributeEnd
)",
                     medium, radius, -thickness);
}

Case extinction() {
  Case c{.group = 7,
         .name = "extinction",
         .about = "optical depth before a lamp: Beer's and Lambert's law",
         .classes = "AE",
         .max_depth = 1};
  for (const double depth : {1e4, 1e-6, 5.0, 1.0, 1e-3}) {
    const auto scene = [depth] {
      return plane_view(16, .5, .5) + slab(homogeneous(.4 * depth, .6 * depth), 1.0, 20.0) + R"(
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "disk" "float radius" 1 "float height" -1.5)";
    };
    c.points.push_back({fmt::format("{}", depth), scene, Means{{std::exp(-depth)}, 2e-4}});
  }
  return c;
}

// What absorbs nothing is not seen in a white sky, whatever its shape, thickness and phase
// function.
std::string white_ball(const std::string& medium) {
  return plane_view(16, .7, .7) + "MakeNamedMedium \"cloud\" " + medium + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "interface"
MediumInterface "cloud" ""
Shape "sphere" "float radius" 1)";
}

// Of a thousand scattering events a path and more: ten per cent would take minutes with each pair.
constexpr double demand_of_walks = .25;

Case white_cloud(const std::string& name, const std::string& about, double demand,
                 const std::vector<std::pair<std::string, std::string>>& media) {
  Case c{.group = 7,
         .name = name,
         .about = about,
         .classes = "ID*E",
         .max_depth = 1000000,
         .demand = demand,
         .bootstrap = 1024};
  c.polite = [] { return white_ball(homogeneous(0.0, 1.0)); };
  for (const auto& [value, medium] : media) {
    c.points.push_back(
        {value, [medium = medium] { return white_ball(medium); }, Means{{1.0}, 2e-3}});
  }
  return c;
}

// Cells of nothing beside cells of 10^4.
std::string spiky_grid(double spike) {
  std::string density;
  for (int i = 0; i < 64; ++i) density += i % 7 == 3 ? fmt::format("{} ", spike) : "0 ";
  return "\"string type\" \"uniformgrid\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ 1 1 1 ] "
         "\"integer nx\" 4 \"integer ny\" 4 \"integer nz\" 4 \"point3 p0\" [ -1 -1 -1 ] \"point3 "
         "p1\" [ 1 1 1 ] \"float density\" [ " +
         density + "]";
}

// Chandrasekhar's H for isotropic scattering at mu = 1 as an integral (Stibbs and Weir 1959, On the
// H-functions for Isotropic Scattering), by the midpoint rule in a variable that resolves
// the logarithm near 0.
double h_function(double albedo) {
  constexpr int n = 2000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double a = (i + .5) / n;
    const double t = .5 * std::numbers::pi * a * a * a, dt = 1.5 * std::numbers::pi * a * a / n;
    sum += std::log1p(-albedo * t / std::tan(t)) * dt;
  }
  return std::exp(-sum / std::numbers::pi);
}

// Light of all directions on a half space: 1 - sqrt(1 - w) H(1) goes up. The slab is 12 diffusion
// lengths deep and the picture 12 of them from its edge.
Case half_space() {
  Case c{.group = 7,
         .name = "half-space",
         .about = "albedo of a half space in a white sky: Chandrasekhar's H function",
         .classes = "ID+E",
         .max_depth = 1000000,
         .bootstrap = 1024};
  for (const double lost : {1e-5, 1e-3, 1e-2, .1, .5}) {
    const double far = 12.0 * std::max(1.3, 1.0 / std::sqrt(3.0 * lost));
    const auto scene = [lost, far] {
      return plane_view(16, .25 * far, .25 * far, 0.0, 3.0 * far) +
             slab(homogeneous(lost, 1.0 - lost), far, 1.25 * far) +
             "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";
    };
    const double value = 1.0 - std::sqrt(lost) * h_function(1.0 - lost);
    c.points.push_back({.value = fmt::format("1-{}", lost),
                        .scene = scene,
                        .oracle = Means{{value}, 3e-3},
                        .aimed = true});
  }
  return c;
}

}  // namespace

void add_media_cases(Cases& cases) {
  cases.push_back(extinction());
  std::vector<std::pair<std::string, std::string>> thick, forward, grids;
  // 10^4 takes a light path of as many bounces: not what has to run in any case.
  for (const double depth : {1e3, 1e4, 1e-6, 1e2, 10.0, 1.0}) {
    thick.emplace_back(fmt::format("{}", depth), homogeneous(0.0, depth));
  }
  for (const double g : {.9999, -.9999, .99, -.9, 0.0}) {
    forward.emplace_back(fmt::format("{}", g), homogeneous(0.0, 5.0, g));
  }
  for (const double spike : {1e4, 1e2, 1.0}) {
    grids.emplace_back(fmt::format("{}", spike), spiky_grid(spike));
  }
  cases.push_back(
      white_cloud("white-cloud", "optical radius of a white cloud in a white sky: 1", .1, thick));
  cases.push_back(
      white_cloud("white-cloud-g", "g of a white cloud in a white sky: 1", .1, forward));
  cases.push_back(
      white_cloud("white-grid", "spikes of a grid between zeros, in a white sky: 1", .1, grids));
  cases.push_back(half_space());
  const auto clouds = cases.end() - 4;
  clouds->points[1].demand = demand_of_walks;  // 10^4
  for (auto c = clouds; c != cases.end(); ++c) c->points.front().demand = demand_of_walks;
}

}  // namespace pssmlt::stress
