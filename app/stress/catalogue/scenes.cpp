#include "app/stress/catalogue/scenes.h"

#include <cmath>
#include <numbers>

namespace pssmlt::stress {
namespace {

// Coordinates of the lab as text.
class Places {
 public:
  explicit Places(const Lab& l) : l_(l), moved_(!l.by_transform) {}
  std::string point(double x, double y, double z) const {
    const double m = moved_ ? 1.0 : 0.0;
    return fmt::format("{} {} {} ", l_.length * x + m * l_.x, l_.length * y + m * l_.y,
                       l_.length * z + m * l_.z);
  }
  std::string eye(double x, double y, double z) const {
    return fmt::format("{} {} {} ", l_.length * x + l_.x, l_.length * y + l_.y,
                       l_.length * z + l_.z);
  }
  std::string quad(const std::string& a, const std::string& b, const std::string& c,
                   const std::string& d) const {
    return "Shape \"bilinearmesh\" \"point3 P\" [ " + a + b + c + d + "]\n";
  }
  // A ball, by a transformation of its own.
  std::string ball(double x, double y, double z, double radius) const {
    return "Translate " + point(x, y, z) +
           fmt::format("\nShape \"sphere\" \"float radius\" {}\n", radius * l_.length);
  }
  std::string rgb(double r, double g, double b, double factor) const {
    return fmt::format("[ {} {} {} ]", r * factor, g * factor, b * factor);
  }

 private:
  const Lab& l_;
  bool moved_;
};

std::string walls(const Places& p) {
  return "Material \"diffuse\" \"rgb reflectance\" [ .7 .6 .5 ]\n" +
         p.quad(p.point(-1, 0, -1), p.point(1, 0, -1), p.point(-1, 0, 1), p.point(1, 0, 1)) +
         p.quad(p.point(-1, 0, 1), p.point(1, 0, 1), p.point(-1, 2, 1), p.point(1, 2, 1)) +
         "Material \"diffuse\" \"rgb reflectance\" [ .3 .6 .4 ]\n" +
         p.quad(p.point(-1, 0, -1), p.point(-1, 0, 1), p.point(-1, 2, -1), p.point(-1, 2, 1));
}

std::string lights(const Lab& l, const Places& p) {
  return "LightSource \"infinite\" \"rgb L\" " + p.rgb(.1, .12, .15, l.radiance) +
         "\nLightSource \"point\" \"rgb I\" " +
         p.rgb(.5, .45, .4, l.radiance * l.length * l.length) + " \"point3 from\" [ " +
         p.point(-.4, 1.6, -.5) + "]\nAttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" " +
         p.rgb(4, 4, 3, l.radiance) + "\n" +
         p.quad(p.point(-.1, 1.9, -.3), p.point(.6, 1.9, -.3), p.point(-.1, 1.9, .3),
                p.point(.6, 1.9, .3)) +
         "AttributeEnd\n";
}

std::string balls(const Lab& l, const Places& p) {
  const double per_length = 1.0 / l.length;
  return "AttributeBegin\nMaterial \"conductor\" \"rgb reflectance\" [ .8 .7 .5 ] \"float "
         "roughness\" .4 \"bool remaproughness\" false\n" +
         p.ball(-.45, .4, .3, .4) +
         "AttributeEnd\nAttributeBegin\nMaterial \"dielectric\" \"float eta\" 1.5\n" +
         p.ball(.45, .4, 0, .35) + "AttributeEnd\nMakeNamedMedium \"fog\" \"string type\" " +
         "\"homogeneous\" \"rgb sigma_a\" " + p.rgb(.2, .1, .1, per_length) + " \"rgb sigma_s\" " +
         p.rgb(1, 2, 1.5, per_length) +
         " \"float g\" .3\nAttributeBegin\nMaterial \"interface\"\nMediumInterface \"fog\" \"\"\n" +
         p.ball(-.2, 1.1, -.2, .3) + "AttributeEnd\n";
}

}  // namespace

std::string lab(const Lab& l) {
  const Places p(l);
  std::string text = film(32, l.height) + "LookAt " + p.eye(0, 1.1, -3.4) + p.eye(0, .9, 0) +
                     "0 1 0\nCamera \"perspective\" \"float fov\" 36 \"float lensradius\" " +
                     fmt::format("{} \"float focaldistance\" {}", .05 * l.length, 3.4 * l.length) +
                     "\nWorldBegin\n";
  if (l.by_transform) text += fmt::format("Translate {} {} {}\n", l.x, l.y, l.z);
  return text + walls(p) + lights(l, p) + balls(l, p);
}

std::string plane_view(int size, double half_width, double half_height, double tilt_degrees,
                       double distance) {
  const double a = tilt_degrees * std::numbers::pi / 180.0;
  const double w = half_width * std::cos(a);
  return film(size, size) +
         fmt::format(
             "LookAt {} 0 {}  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" "
             "[ {} {} {} {} ]\nWorldBegin\n",
             distance * std::sin(a), distance * std::cos(a), -w, w, -half_height, half_height);
}

constexpr double lamp_height = 1.5, lamp_intensity = 3.0;

std::vector<double> lit_quarters(double half) {
  std::vector<double> values;
  constexpr int n = 200;
  for (int q = 0; q < 4; ++q) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double x = half * (i + .5) / n, y = half * (j + .5) / n;
        const double d2 = x * x + y * y + lamp_height * lamp_height;
        sum += lamp_intensity * lamp_height / (d2 * std::sqrt(d2)) / (n * n);
      }
    }
    values.push_back(.6 / std::numbers::pi * sum);
  }
  return values;
}

double fresnel_reflectance(double cosine, double eta) {
  const double sin2 = (1.0 - cosine * cosine) / (eta * eta);
  if (sin2 >= 1.0) return 1.0;
  const double cos_t = std::sqrt(1.0 - sin2);
  const double parallel = (eta * cosine - cos_t) / (eta * cosine + cos_t);
  const double perpendicular = (cosine - eta * cos_t) / (cosine + eta * cos_t);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

}  // namespace pssmlt::stress
