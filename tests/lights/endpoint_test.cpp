// Every light and camera as an endpoint: what emit(), toward(), evaluate() and pdf_toward() say of
// the same ray is the same, and both ways of finding a receiver carry the same flux to it.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/image/image.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

struct Case {
  const char* name;
  std::function<std::shared_ptr<Endpoint>()> make;
  bool camera = false;
  int emitting = 4000;  // of 5000 numbers, at least
};

const RasterFrame& frame() {
  static const RasterFrame f{{64, 48}, {8, 4}, {56, 44}, {0.f, 0.f}};
  return f;
}

// An equal-area map of random texels, one of them a thousand times as bright, one black.
std::string environment_file() {
  static const std::string path = [] {
    Image image(8, 8, 3);
    RandomStream random(9, RandomUse::test);
    for (float& v : image.data) v = 0.1f + random.next();
    for (int c = 0; c < 3; ++c) {
      image.pixel(5, 2)[c] *= 300.f;
      image.pixel(1, 1)[c] = 0.f;
    }
    const std::string file = test::own_file("environment-test.pfm");
    write_image(file, image, {}, {});
    return file;
  }();
  return path;
}

Case light(const char* name, const std::string& text) {
  return {name, [text]() -> std::shared_ptr<Endpoint> {
            const auto made = make_light(text);
            made->prepare({vec3(0.f), 4.f});
            return made;
          }};
}
// The same with an image.
Case image_light(const char* name, const std::string& text) {
  return {name, [name, text] {
            return light(name, text + " \"string filename\" \"" + environment_file() + "\"").make();
          }};
}
// A projector at (1, 2, 1) that looks at the origin.
constexpr const char* slide = "Translate 1 2 1 Rotate -135 0 1 0 Rotate 54.7 1 0 0 ";
Case camera(const char* name, const std::string& text) {
  return {name, [text]() -> std::shared_ptr<Endpoint> { return make_camera(text, frame()); }, true};
}

// Wide angle, with a stop of half its opening; the film is 40 mm wide.
Case lens_camera(const char* name, const std::string& text) {
  return {name,
          [text]() -> std::shared_ptr<Endpoint> {
            const std::string file = test::own_file("endpoint-lens.dat");
            std::ofstream(file) << "60 8 1.6 50\n-90 3 1 50\n0 60 0 36\n";
            RasterFrame film = frame();
            film.diagonal = 50.f;
            return make_camera(text + " Camera \"realistic\" \"string lensfile\" \"" + file +
                                   "\" \"float aperturediameter\" 24 \"float focusdistance\" 1",
                               film);
          },
          true,
          // The stop's circle in its square, and vignetting.
          3000};
}

std::vector<Case> cases() {
  const std::string area = "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] ";
  const std::string both = "AreaLightSource \"diffuse\" \"bool twosided\" true ";
  return {
      light("Point", "LightSource \"point\" \"point3 from\" [1 2 1] \"float scale\" 3"),
      light("Spot",
            "LightSource \"spot\" \"point3 from\" [1 2 1] \"point3 to\" [0.3 0 0]"
            "\"float coneangle\" 40 \"float conedeltaangle\" 25"),
      light("SpotHard",
            "LightSource \"spot\" \"point3 from\" [1 2 1] \"point3 to\" [0 0 0]"
            "\"float conedeltaangle\" 0"),
      light("Distant", "LightSource \"distant\" \"point3 from\" [1 2 3] \"rgb L\" [3 2 1]"),
      light("Constant", "LightSource \"infinite\" \"rgb L\" [1 2 3]"),
      image_light("Image", "Rotate 50 1 2 3 LightSource \"infinite\""),
      image_light("ImageStretched", "Rotate 50 1 2 3 Scale -1 2 1 LightSource \"infinite\""),
      image_light(
          "Longitudes",
          "Rotate 50 1 2 3 LightSource \"infinite\" \"string mapping\" \"equirectangular\""),
      image_light("LongitudesStretched",
                  "Rotate 50 1 2 3 Scale -1 2 1 LightSource \"infinite\""
                  "\"string mapping\" \"equirectangular\""),
      light("Portal",
            "LightSource \"infinite\" \"point3 portal\" [-1 1.5 -1  1 1.5 -1  1 1.5 1  -1 1.5 1]"),
      image_light("PortalImage",
                  "Rotate 50 1 2 3 LightSource \"infinite\""
                  "\"point3 portal\" [-1 1.5 -1  1 1.5 -1  1 1.5 1  -1 1.5 1]"),
      // Turned so that the bright texel looks at the receiver.
      image_light("Goniometric",
                  "Translate 1 2 1 Rotate 110.9 -.747 .556 -.365 LightSource \"goniometric\""
                  "\"rgb I\" [1 2 3]"),
      image_light("GoniometricStretched",
                  "Translate 1 2 1 Rotate 98.9 -1 0 1 Scale -1 2 1 LightSource \"goniometric\""),
      image_light("Projection", std::string(slide) + "LightSource \"projection\""),
      image_light("ProjectionStretched", std::string(slide) +
                                             "Rotate 20 1 0 0 Scale -1 0.7 1.2 LightSource"
                                             "\"projection\" \"float fov\" 70"),
      light("SphereLight", area + "Translate 2 0 1 Shape \"sphere\" \"float radius\" 0.7"),
      light("EllipsoidLight", area + "Translate 2 0 1 Scale 1 -0.5 0.3 Shape \"sphere\""),
      light("DiskBothSides", both + "Rotate 90 1 0 0 Shape \"disk\" \"float height\" 1"),
      light("DiskOneSide", area + "Rotate 90 1 0 0 Shape \"disk\" \"float height\" -1"),
      light("CylinderLight", area + "ReverseOrientation Shape \"cylinder\" \"float radius\" 1.5"),
      light("MeshLight", area + "Shape \"trianglemesh\" \"integer indices\" [0 1 2 2 1 3]"
                                "\"point3 P\" [-1 2 -1  1 2 -1  -1 2 1  1 2.5 1]"),
      light("PatchLight", area + "Shape \"bilinearmesh\""
                                 "\"point3 P\" [-1 2 -1  1 2 -1  -1 2 1  1 2.9 1]"),
      camera("Pinhole", "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 70"),
      camera("ThinLens",
             "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 70"
             "\"float lensradius\" 0.3 \"float focaldistance\" 1.7"),
      camera("ScaledLens",
             "Scale -0.5 0.7 0.9 LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"perspective\""
             "\"float lensradius\" 0.3 \"float focaldistance\" 1.7"
             "\"float screenwindow\" [-1 1.5 -0.7 1]"),
      camera("Parallel", "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"orthographic\""),
      camera("ParallelScaled",
             "Scale -0.5 0.7 0.9 LookAt 1 1.5 1 0 0 0 0 1 0"
             " Camera \"orthographic\" \"float frameaspectratio\" 2"),
      camera("SphericalEqualArea", "LookAt 1 1.5 1 2 0.5 1.5 -1 -1.5 -1 Camera \"spherical\""),
      camera("SphericalLongitudes",
             "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"spherical\" \"string mapping\""
             "\"equirectangular\""),
      camera("SphericalStretched",
             "Scale -0.5 0.7 0.9 LookAt 1 1.5 1 2 0.5 1.5 -1 -1.5 -1 Camera \"spherical\""),
      lens_camera("Lenses", "LookAt 1 1.5 1 0 0 0 0 1 0"),
      lens_camera("LensesScaled", "Scale -2 3 2.5 LookAt 1 1.5 1 0 0 0 0 1 0"),
      camera("SensorPoint", "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"irradiance\""),
      camera("SensorRectangle",
             "LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"irradiance\" \"string surface\" \"rectangle\""
             "\"vector3 normal\" [0.2 0.1 1] \"float width\" 0.5"),
      camera("SensorDisk",
             "Scale -0.5 0.7 0.9 LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"irradiance\""
             "\"string surface\" \"disk\""),
      camera("SensorSphere",
             "Scale -0.5 0.7 0.9 LookAt 1 1.5 1 0 0 0 0 1 0 Camera \"irradiance\""
             "\"string surface\" \"sphere\" \"float radius\" 0.4")};
}

class EndpointTest : public testing::TestWithParam<Case> {
 protected:
  EndpointTest() : endpoint_(GetParam().make()) {}
  std::optional<Emission> emit(RandomStream& random) const {
    const vec2 position = draw2(random);
    const vec2 direction = draw2(random);
    dvec2 d(direction);
    if (GetParam().camera) d = dvec2(frame().crop_min) + d * dvec2(frame().crop_size());
    return endpoint_->emit(position, d);
  }
  std::shared_ptr<Endpoint> endpoint_;
  RandomStream random_{17, RandomUse::test};
};

constexpr float close = 2e-3f;  // relative, for values that steep functions of a direction give

void expect_near(const Rgb& a, const Rgb& b) {
  EXPECT_LE(glm::length(a - b), close * glm::length(b)) << a.x << " " << b.x;
}

TEST_P(EndpointTest, EmissionAgreesWithEvaluate) {
  int emitted = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto e = emit(random_);
    if (!e) continue;
    ++emitted;
    EXPECT_NEAR(glm::length(e->direction), 1.f, 1e-5f);
    if (e->cosine < 1e-3f) continue;  // rounding of the direction
    const EmissionValue v = endpoint_->evaluate(e->from, e->direction);
    // A window's edge: the ray may round to its outside.
    if (GetParam().camera && is_black(v.value)) continue;
    expect_near(e->value, v.value);
    EXPECT_NEAR(e->cosine / v.cosine, 1.f, close);
    EXPECT_NEAR(e->pdf_position / v.pdf_position, 1.f, close);
    EXPECT_NEAR(e->pdf_direction / v.pdf_direction, 1.f, close);
    const auto* const camera = dynamic_cast<const Camera*>(endpoint_.get());
    if (camera && camera->bare()) {
      EXPECT_NEAR(e->weight().x, pi, close * pi);
    } else if (camera && !camera->measures_irradiance()) {
      EXPECT_NEAR(e->weight().x, 1.f, close);
    }
  }
  EXPECT_GT(emitted, GetParam().emitting);
}

TEST_P(EndpointTest, TowardAgreesWithEvaluate) {
  int found = 0;
  for (int i = 0; i < 5000; ++i) {
    const vec3 reference = 0.8f * uniform_sphere(draw2(random_));
    const auto t = endpoint_->toward(reference, draw2(random_));
    if (!t || t->cosine < 1e-3f) continue;
    ++found;
    const EmissionValue v = endpoint_->evaluate(t->at, -t->wi);
    if (GetParam().camera && is_black(v.value)) continue;
    expect_near(t->value, v.value);
    EXPECT_NEAR(t->cosine / v.cosine, 1.f, close);
    EXPECT_NEAR(t->pdf_position / v.pdf_position, 1.f, close);
    EXPECT_NEAR(t->pdf_direction / v.pdf_direction, 1.f, close);
    EXPECT_NEAR(endpoint_->pdf_toward(reference, t->at) / t->pdf_toward, 1.f, 5e-3f);
    if (!endpoint_->traits().infinite) {
      EXPECT_LT(glm::distance(reference + t->distance * t->wi, t->at.position), 1e-5f);
    }
  }
  EXPECT_GT(found, 300);
}

// What a small disk receives (luminance, both sides): traced from the endpoint, and connected from
// the disk. The difference of two means of 2e5 samples.
TEST_P(EndpointTest, BothDirectionsCarryTheSameFlux) {
  const vec3 center(0.1f, -0.2f, 0.15f);
  const Frame disk(glm::normalize(vec3(0.3f, 1.f, 0.2f)));
  constexpr float radius = 0.45f;
  double traced = 0.0, traced2 = 0.0, connected = 0.0, connected2 = 0.0;
  constexpr int n = 200'000;
  for (int i = 0; i < n; ++i) {
    double x = 0.0;
    if (const auto e = emit(random_)) {
      const float t = glm::dot(center - e->from.position, disk.n) / glm::dot(e->direction, disk.n);
      const vec3 p = e->from.position + t * e->direction;
      if (t > 0.f && glm::distance(p, center) < radius) x = luminance(e->weight());
    }
    traced += x;
    traced2 += x * x;
    const vec2 on_disk = radius * concentric_disk(draw2(random_));
    const vec3 reference = center + on_disk.x * disk.s + on_disk.y * disk.t;
    double y = 0.0;
    if (const auto t = endpoint_->toward(reference, draw2(random_)))
      y = luminance(t->value) * std::abs(glm::dot(t->wi, disk.n)) / t->pdf_toward * pi * radius *
          radius;
    connected += y;
    connected2 += y * y;
  }
  const auto variance = [](double sum, double sum2) { return (sum2 - sum * sum / n) / n / n; };
  const double sigma = std::sqrt(variance(traced, traced2) + variance(connected, connected2));
  EXPECT_GT(traced, 0.0);
  EXPECT_LT(sigma, 0.05 * traced / n);
  EXPECT_NEAR(traced / n, connected / n, z_limit * sigma);
}

INSTANTIATE_TEST_SUITE_P(All, EndpointTest, testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Directions of lights whose density does not depend on the position.
class EmittedDirections : public testing::TestWithParam<Case> {};

TEST_P(EmittedDirections, FollowTheirDensity) {
  const auto endpoint = GetParam().make();
  RandomStream first(3, RandomUse::test);
  EndpointPoint at;
  for (bool found = false; !found;) {
    const vec2 u = draw2(first);
    if (const auto e = endpoint->emit(u, dvec2(draw2(first)))) {
      at = e->from;
      found = true;
    }
  }
  // Texels and cones have sharp edges: the density is integrated finely.
  const ChiSquareOptions options{.bins_x = 48, .bins_y = 48, .samples = 200'000, .fine = 48};
  const auto result = chi_square_sphere(
      [&](RandomStream& random) -> std::optional<vec3> {
        const vec2 u = draw2(random);
        const auto e = endpoint->emit(u, dvec2(draw2(random)));
        return e ? std::optional(e->direction) : std::nullopt;
      },
      [&](const vec3& d) { return endpoint->evaluate(at, d).pdf_direction; }, options);
  EXPECT_GT(result.p, false_alarm);
  EXPECT_NEAR(result.integral + result.failures, 1.0, 2e-3);
}

std::vector<Case> directional_cases() {
  std::vector<Case> chosen;
  for (const Case& c : cases())
    for (const char* name : {"Point", "Spot", "Constant", "Image", "ImageStretched", "Goniometric",
                             "GoniometricStretched", "Projection", "ProjectionStretched",
                             "DiskBothSides", "DiskOneSide"})
      if (std::string(name) == c.name) chosen.push_back(c);
  return chosen;
}

INSTANTIATE_TEST_SUITE_P(All, EmittedDirections, testing::ValuesIn(directional_cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace pssmlt
