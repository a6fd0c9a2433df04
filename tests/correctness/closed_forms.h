// Scenes whose pictures are known in closed form (or by quadrature of a formula written here, not
// by the renderer's own code).
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace pssmlt::test {

struct ClosedForm {
  std::string name, scene;
  std::string classes;  // of the light that `values` counts
  int max_depth = 0;
  std::vector<double> values;  // luminance of the four quadrants [W/(m^2 sr)], or of the whole
  bool half_percent = false;   // the mean is held to 0.5 %
  bool costly = false;         // by the usual integrators alone: minutes by others
};

// 8 x 8 pixels of the plane z = 0, seen from above along the tilted axis.
inline std::string view(const std::string& window, int depth, double tilt_degrees = 0.0,
                        double height = 10.0) {
  const double a = tilt_degrees * std::numbers::pi / 180.0;
  return fmt::format(R"(
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
LookAt {} 0 {}  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ {} ]
Sampler "pssmlt" "integer bootstrapsamples" 4096 "integer chains" 32
  "float filmprobability" 0.1 "float streamprobability" 0.2
  "float largestepprobability" .8
Integrator "path" "integer maxdepth" {}
WorldBegin
)",
                     height * std::sin(a), height * std::cos(a), window, depth);
}

// The mean of f(x, y) over each quadrant of the window, in the order of the picture's blocks. The
// camera looks down with y up in the picture and a left-handed frame: x grows to the left.
inline std::vector<double> quadrants(double x0, double x1, double y0, double y1,
                                     const std::function<double(double, double)>& f) {
  constexpr int n = 200;
  std::vector<double> means;
  for (int q = 0; q < 4; ++q) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double u = (q % 2 + (i + 0.5) / n) / 2, v = (q / 2 + (j + 0.5) / n) / 2;
        sum += f(-(x0 + u * (x1 - x0)), y1 - v * (y1 - y0));
      }
    }
    means.push_back(sum / (n * n));
  }
  return means;
}

// Directional albedo of a single scattering event on GGX facets that reflect everything, by the
// midpoint rule over the hemisphere: integral of D G2 / (4 cos_o) d omega, Smith's
// height-correlated G2 (Heitz 2014, eq. 72, 99).
inline double ggx_albedo(double alpha, double cos_o) {
  constexpr int n = 1500;
  const auto lambda = [alpha](double c) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - c * c) / (c * c)) - 1.0);
  };
  const double sin_o = std::sqrt(1.0 - cos_o * cos_o);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double c = (i + 0.5) / n, s = std::sqrt(1.0 - c * c);
    for (int j = 0; j < n; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / n;
      const double hx = sin_o + s * std::cos(phi), hy = s * std::sin(phi), hz = cos_o + c;
      const double cos2 = hz * hz / (hx * hx + hy * hy + hz * hz);
      const double t = cos2 * (alpha * alpha - 1.0) + 1.0;
      const double d = alpha * alpha / (std::numbers::pi * t * t);
      sum += d / (1.0 + lambda(cos_o) + lambda(c)) / (4.0 * cos_o);
    }
  }
  return sum * 2.0 * std::numbers::pi / (static_cast<double>(n) * n);
}

// Reflectance of a smooth interface for unpolarised light (Fresnel).
inline double fresnel(double cos_i, double eta) {
  const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (eta * eta));
  const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

inline ClosedForm furnace() {
  return {"furnace",
          view("-.7 .7 -.7 .7", 1) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "diffuse" "rgb reflectance" [ 1 1 1 ]
Shape "disk" "float radius" 1)",
          "IDE",
          1,
          {1.0},
          true};
}

// A disk in the furnace, looked at under an angle.
inline ClosedForm ggx(const std::string& name, double alpha, double angle) {
  const double cos_o = std::cos(angle * std::numbers::pi / 180.0);
  const std::string window = fmt::format("{0} {1} -.7 .7", -.7 * cos_o, .7 * cos_o);
  return {name,
          view(window, 1, angle) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "conductor" "rgb reflectance" [ 1 1 1 ] "bool remaproughness" false
  "float roughness" )" +
              fmt::format("{}", alpha) + R"(
Shape "disk" "float radius" 1)",
          "IDE",
          1,
          {ggx_albedo(alpha, cos_o)},
          true};
}

// Radiance grows with the squared index: a ray that leaves glass into air carries 1 / eta^2 of it.
inline ClosedForm boundary() {
  const double r = fresnel(1.0, 1.5);
  return {"boundary",
          view("-.5 .5 -.5 .5", 1) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "dielectric" "float eta" 1.5
Shape "disk" "float radius" 1)",
          "IS*E",
          1,
          {r + (1.0 - r) / (1.5 * 1.5)},
          true};
}

// A plane-parallel plate in the furnace: reflected, transmitted, and after inner reflections.
inline ClosedForm slab() {
  const double r = fresnel(std::cos(std::numbers::pi / 4), 1.5);
  return {"slab",
          view("-1 1 -1 1", 4, 45.0) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "dielectric" "float eta" 1.5
Shape "disk" "float radius" 20 "float height" .5
ReverseOrientation
Shape "disk" "float radius" 20 "float height" 0)",
          "IS*E",
          4,
          {r + (1.0 - r) * (1.0 - r) * (1.0 + r + r * r)},
          true};
}

inline ClosedForm integrating_sphere(double rho, int depth) {
  return {fmt::format("sphere_{}_{}", static_cast<int>(10 * rho), depth),
          fmt::format(R"(
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
LookAt .3 -.2 .1  -.4 .1 1  0 1 0
Camera "perspective" "float fov" 60
Sampler "pssmlt" "integer bootstrapsamples" 4096 "integer chains" 32
  "float filmprobability" 0.1 "float streamprobability" 0.2
  "float largestepprobability" .8
Integrator "path" "integer maxdepth" {}
WorldBegin
ReverseOrientation
Material "diffuse" "rgb reflectance" [ {} {} {} ]
AreaLightSource "diffuse" "rgb L" [ 2 2 2 ]
Shape "sphere" "float radius" 1)",
                      depth, rho, rho, rho),
          "AD*E",
          depth,
          {2.0 * (1.0 - std::pow(rho, depth + 1)) / (1.0 - rho)},
          false};
}

// A light that sends `irradiance(x, y)` [W/m^2] onto the plane, which reflects 0.6 of it.
inline ClosedForm lit_plane(const std::string& name, const std::string& light,
                            const std::function<double(double, double)>& irradiance) {
  const auto radiance = [&](double x, double y) {
    return 0.6 / std::numbers::pi * irradiance(x, y);
  };
  return {name,
          view("-.4 1.2 -.9 .3", 1) + light + R"(
Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
Shape "disk" "float radius" 2)",
          "PDE",
          1,
          quadrants(-.4, 1.2, -.9, .3, radiance),
          false};
}

// Intensity 3 from the point (.2, .1, 1.5), straight above it: I cos / d^2.
inline double below_the_point(double x, double y) {
  const double d2 = (x - .2) * (x - .2) + (y - .1) * (y - .1) + 1.5 * 1.5;
  return 3.0 * 1.5 / (d2 * std::sqrt(d2));
}

// A slab of a medium, z from 0 to `thickness`, between disks that cannot be seen.
inline std::string medium_slab(const std::string& medium, double thickness, double radius) {
  return fmt::format(R"(
MakeNamedMedium "slab" {0}
AttributeBegin
  Material "interface"
  MediumInterface "slab" ""
  Shape "disk" "float radius" {1} "float height" {2}
  ReverseOrientation
  Shape "disk" "float radius" {1} "float height" 0
AttributeEnd
)",
                     medium, radius, thickness);
}

// Beer, Lambert: a lamp seen through a medium that scatters and absorbs, neither of which is seen.
inline ClosedForm extinction() {
  const std::string medium =
      R"("string type" "homogeneous" "rgb sigma_a" [ .3 .2 .1 ] "rgb sigma_s" [ .5 .4 .8 ])";
  const double seen =
      .2126 * std::exp(-.8 * 1.5) + .7152 * std::exp(-.6 * 1.5) + .0722 * std::exp(-.9 * 1.5);
  return {"extinction",
          view("-.5 .5 -.5 .5", 1) + medium_slab(medium, 1.5, 20.0) + R"(
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "disk" "float radius" 1 "float height" -.5)",
          "AE",
          1,
          {seen},
          true};
}

// Light from afar at 60 degrees, scattered once toward a camera that looks straight down:
// sigma_s p(cos) L (1 - exp(-sigma_t h (1 + 1 / mu))) / (sigma_t (1 + 1 / mu)) (Chandrasekhar 1960,
// Radiative Transfer, section 22).
inline ClosedForm single_scattering(double g) {
  const double mu = .5, sigma_s = .6, sigma_t = 1.0, thickness = .8;
  const double base = 1.0 + g * g + 2.0 * g * mu;
  const double phase = (1.0 - g * g) / (4.0 * std::numbers::pi * base * std::sqrt(base));
  const double path = sigma_t * (1.0 + 1.0 / mu);
  const std::string medium = fmt::format(
      R"("string type" "homogeneous" "rgb sigma_a" [ .4 .4 .4 ] "rgb sigma_s" [ .6 .6 .6 ]
         "float g" {})",
      g);
  return {g == 0.0 ? "single_scattering" : "single_scattering_forward",
          view("-1.6 1.6 -1.6 1.6", 1) + medium_slab(medium, thickness, 3.5) +
              fmt::format(R"(
LightSource "distant" "rgb L" [ 3 3 3 ] "point3 from" [ {} 0 {} ] "point3 to" [ 0 0 0 ])",
                          std::sqrt(.75), mu),
          "PDE",
          1,
          {sigma_s * phase * 3.0 * (1.0 - std::exp(-path * thickness)) / path},
          false};
}

// Chandrasekhar's H for isotropic scattering, by iteration of its integral equation (Chandrasekhar
// 1960, section 38): 1 / H(mu) = sqrt(1 - w) + w / 2 int H(x) x / (mu + x) dx.
inline double h_function(double albedo, double mu) {
  constexpr int n = 400;
  std::vector<double> h(n, 1.0);
  const auto next = [&](double at) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      sum += h[static_cast<size_t>(i)] * x / (at + x) / n;
    }
    return 1.0 / (std::sqrt(1.0 - albedo) + .5 * albedo * sum);
  };
  for (int round = 0; round < 60; ++round) {
    std::vector<double> better;
    for (int i = 0; i < n; ++i) better.push_back(next((i + 0.5) / n));
    h = better;
  }
  return next(mu);
}

// What a half space sends up of light that comes from all directions alike: 1 - sqrt(1 - w) H(mu).
// Light diffuses by 1.3 mean free paths here at most (1 / sqrt(3 (1 - w))): the disk's edge, at 12
// of them from the picture's, and the depth of 12 are as good as endless.
inline ClosedForm half_space(double albedo, int depth) {
  const std::string medium = fmt::format(
      R"("string type" "homogeneous" "rgb sigma_a" [ {0} {0} {0} ] "rgb sigma_s" [ {1} {1} {1} ])",
      1.0 - albedo, albedo);
  return {fmt::format("half_space_{}", static_cast<int>(10.0 * albedo)),
          view("-4 4 -4 4", depth, 0.0, 40.0) + medium_slab(medium, 12.0, 16.0) + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ])",
          "ID+E",
          depth,
          {1.0 - std::sqrt(1.0 - albedo) * h_function(albedo, 1.0)},
          albedo < .6,
          true};
}

// A cloud that absorbs nothing cannot be seen in a uniform sky, whatever its shape.
inline ClosedForm white_cloud(const std::string& name, const std::string& medium) {
  return {name,
          view("-.7 .7 -.7 .7", 24) + "MakeNamedMedium \"cloud\" " + medium + R"(
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "interface"
MediumInterface "cloud" ""
Shape "sphere" "float radius" 1)",
          "ID*E",
          24,
          {1.0},
          true};
}

inline std::vector<ClosedForm> media_forms() {
  return {extinction(),
          single_scattering(0.0),
          single_scattering(.6),
          half_space(.5, 24),
          half_space(.8, 60),
          white_cloud("white_fog", R"("string type" "homogeneous" "rgb sigma_a" [ 0 0 0 ]
            "rgb sigma_s" [ .4 .6 .9 ] "float g" .3)"),
          white_cloud("white_smoke", R"("string type" "uniformgrid" "rgb sigma_a" [ 0 0 0 ]
            "rgb sigma_s" [ .4 .6 .9 ] "integer nx" 2 "integer ny" 3 "integer nz" 2
            "point3 p0" [ -1 -1 -1 ] "point3 p1" [ 1 1 1 ]
            "float density" [ .1 2 1 .5 3 .2 .9 1.4 0 2 1 .4 ])")};
}

inline std::vector<ClosedForm> closed_forms() {
  constexpr double disks = std::numbers::pi * (3.0 - 2.0 * std::numbers::sqrt2);
  std::vector<ClosedForm> forms = {
      furnace(),
      ggx("ggx", .5, 0.0),
      ggx("ggx_oblique", .4, 60.0),
      boundary(),
      slab(),
      integrating_sphere(.5, 0),
      integrating_sphere(.5, 1),
      integrating_sphere(.5, 2),
      integrating_sphere(.5, 5),
      integrating_sphere(.9, 1),
      integrating_sphere(.9, 3),
      lit_plane("point", R"(LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ .2 .1 1.5 ])",
                below_the_point),
      lit_plane("spot", R"(LightSource "spot" "rgb I" [ 3 3 3 ] "point3 from" [ .2 .1 1.5 ]
                           "point3 to" [ .2 .1 0 ] "float coneangle" 80
                           "float conedeltaangle" 5)",
                below_the_point),
      lit_plane("distant", R"(LightSource "distant" "rgb L" [ 2 2 2 ] "point3 from" [ 3 0 4 ]
                              "point3 to" [ 0 0 0 ])",
                [](double, double) { return 2.0 * .8; }),
      // Mean irradiance of a unit disk below another of radiance 1 at distance 2; the disk
      // fills pi / 4 of the picture.
      {"disks",
       view("-1 1 -1 1", 1, 0.0, 1.5) + R"(
Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]
Shape "disk" "float radius" 1
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
ReverseOrientation
Shape "disk" "float radius" 1 "float height" 2)",
       "ADE",
       1,
       {.5 / 4.0 * disks},
       true}};
  for (ClosedForm& form : media_forms()) forms.push_back(std::move(form));
  return forms;
}

}  // namespace pssmlt::test
