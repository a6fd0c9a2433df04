// Group 9: cameras. All look into a room in which the radiance is the same everywhere.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

constexpr double radiance = (1.0 - 1.0 / 512.0) / .5;  // 1 + 1/2 + ... + 1/2^8

std::string room(const std::string& picture, const std::string& transform,
                 const std::string& camera) {
  return picture + transform + "\nLookAt .3 -.2 .1  -.4 .1 1  0 1 0\nCamera " + camera + R"(
WorldBegin
ReverseOrientation
Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "sphere" "float radius" 1)";
}

std::string perspective(double fov) { return fmt::format("\"perspective\" \"float fov\" {}", fov); }

Case in_room(const std::string& name, const std::string& about) {
  Case c{.group = 9, .name = name, .about = about, .classes = "AD*E", .max_depth = 8};
  c.polite = [] { return room(film(16, 16), "", perspective(60)); };
  return c;
}

void add(Case& c, const std::string& value, const std::string& picture,
         const std::string& transform, const std::string& camera, bool aimed = false) {
  c.points.push_back({.value = value,
                      .scene = [=] { return room(picture, transform, camera); },
                      .oracle = Means{{radiance}, 1e-3},
                      .aimed = aimed});
}

Case field_of_view() {
  Case c = in_room("fov", "field of view [degrees] in a room: closed form");
  for (const double fov : {.01, 179.9, .1, 179.0, 60.0}) {
    add(c, fmt::format("{}", fov), film(16, 16), "", perspective(fov), fov < 1.0);
    // Of light subpaths hardly any lands in the middle, where a pixel is as wide as the room.
    if (fov > 170.0) c.points.back().demand = .25;
  }
  return c;
}

Case lens() {
  Case c = in_room("lens", "radius of the lens in a room of radius 1: closed form");
  for (const double radius : {1e-9, .5, 1e-5, .1}) {
    add(c, fmt::format("{}", radius), film(16, 16), "",
        perspective(60) +
            fmt::format(" \"float lensradius\" {} \"float focaldistance\" .7", radius));
  }
  return c;
}

Case transforms() {
  Case c = in_room("camera-transform", "transformation of the camera: closed form");
  for (const char* scale : {"1 1 1e-6", "1e-6 1 1", "-1 1 1", "1e-3 1e3 1", "2 2 2"}) {
    add(c, scale, film(16, 16), "Scale " + std::string(scale), perspective(60),
        std::string(scale).find("1e") != std::string::npos);
  }
  return c;
}

Case sizes() {
  Case c = in_room("picture-size", "size of the picture: closed form");
  add(c, "1x1", film(1, 1), "", perspective(60));
  add(c, "1x100000", film(1, 100000), "", perspective(60), true);
  add(c, "20000x20000",
      "Film \"rgb\" \"integer xresolution\" 20000 \"integer yresolution\" 20000 \"integer "
      "pixelbounds\" [ 19000 19016 500 516 ]\nPixelFilter \"box\"\n",
      "", perspective(60), true);
  add(c, "16x16", film(16, 16), "", perspective(60));
  return c;
}

}  // namespace

void add_camera_cases(Cases& cases) {
  cases.push_back(field_of_view());
  cases.push_back(lens());
  cases.push_back(transforms());
  cases.push_back(sizes());
}

}  // namespace pssmlt::stress
