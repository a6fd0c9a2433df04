// A slide projector: a point that emits an image into a pyramid, upright and unmirrored as the
// light's space is seen along +z (x right, y up).
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.2.2. A pixel's
// intensity is the same in all its directions. Pixels are chosen by luminance and solid angle (a
// rectangle's as four right-angled corners, Van Oosterom and Strackee 1983), a point in the pixel
// uniformly on the screen. Blind spot: rays never meet the light.
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "core/base/distribution.h"
#include "core/light_image.h"
#include "core/light_point.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Solid angle [sr] of the rectangle from (0, 0) to (x, y) at depth 1; negative for one negative
// side.
double corner(double x, double y) { return std::atan(x * y / std::sqrt(1.0 + x * x + y * y)); }

class ProjectionLight final : public PointEmitter {
 public:
  static constexpr const char* summary = "Point that projects an image";

  explicit ProjectionLight(Parameters& p) {
    const float scale = p.number("scale", 1.f, "", "Factor of the image [W/sr].");
    const float power =
        p.number("power", -1.f, "W", "Total emitted power; negative: from the image.");
    const float fov = p.number("fov", 90.f, "degrees", "Angle of view along the shorter side.");
    const std::string file = p.file("filename", "The image; needed.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (!(fov > 0.f && fov < 180.f)) p.fail("fov", "\"fov\" must lie between 0 and 180 degrees");
    if (p.describing()) return;
    if (file.empty()) p.fail("filename is needed");
    image_ = read_light_image(p, file);
    place(p.transform(), std::tan(glm::radians(0.5 * static_cast<double>(fov))));
    prepare_sampling();
    if (power > 0.f && !(natural_power_ > 0.0)) p.fail("power", "the image is black");
    scale_ = power > 0.f ? scale * power / static_cast<float>(natural_power_) : scale;
  }

  float power() const override { return scale_ * static_cast<float>(natural_power_); }

 private:
  void place(const Transform& transform, double tangent) {
    const double aspect = static_cast<double>(image_.width) / image_.height;
    half_size_ = tangent * dvec2(std::max(aspect, 1.0), std::max(1.0 / aspect, 1.0));
    to_render_ = glm::dmat3(transform.matrix());
    to_light_ = glm::inverse(to_render_);
    determinant_ = std::abs(glm::determinant(to_render_));
    position_ = vec3(transform.point(dvec3(0.0)));
  }
  // Of a point of the image, on the screen at depth 1; and back.
  dvec2 screen(const dvec2& uv) const {
    return half_size_ * dvec2(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y);
  }
  dvec2 on_image(const dvec2& screen) const {
    const dvec2 s = screen / half_size_;
    return {0.5 + 0.5 * s.x, 0.5 - 0.5 * s.y};
  }

  // Sums the power in luminance [W] for scale 1, exactly unless the light is stretched.
  void prepare_sampling() {
    std::vector<float> weights;
    natural_power_ = 0.0;
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        const dvec2 a = screen(dvec2(x, y + 1) / dvec2(image_.width, image_.height));
        const dvec2 b = screen(dvec2(x + 1, y) / dvec2(image_.width, image_.height));
        const double solid_angle =
            corner(b.x, b.y) - corner(a.x, b.y) - corner(b.x, a.y) + corner(a.x, a.y);
        const double flux = static_cast<double>(luminance(image_.at(x, y))) * solid_angle;
        natural_power_ += flux;
        weights.push_back(static_cast<float>(flux));
      }
    distribution_ = Distribution2D(weights, image_.width, image_.height);
  }

  std::optional<vec3> sample_direction(const dvec2& u) const override {
    if (!(distribution_.sum() > 0.0)) return std::nullopt;
    return vec3(glm::normalize(to_render_ * dvec3(screen(distribution_.sample(u).uv), 1.0)));
  }
  // The point of the image in a direction; nullopt outside.
  std::optional<dvec2> image_point(const dvec3& d) const {
    if (!(d.z > 0.0)) return std::nullopt;
    const dvec2 uv = on_image(dvec2(d) / d.z);
    if (!(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0)) return std::nullopt;
    return uv;
  }
  // An area of the screen dA has the solid angle determinant d.z^3 dA in render space, where d is
  // the unit direction there, taken to the light's space.
  float pdf_direction(const vec3& direction) const override {
    const dvec3 d = to_light_ * dvec3(direction);
    const auto uv = image_point(d);
    if (!uv) return 0.f;
    const double screen_area = 4.0 * half_size_.x * half_size_.y;
    return static_cast<float>(distribution_.pdf(*uv) /
                              (screen_area * determinant_ * d.z * d.z * d.z));
  }
  Rgb intensity(const vec3& direction) const override {
    const auto uv = image_point(to_light_ * dvec3(direction));
    return uv ? scale_ * image_.nearest(*uv) : Rgb(0.f);
  }

  DirectionCone directions() const override {
    const auto direction = [this](double x, double y) {
      return vec3(glm::normalize(to_render_ * dvec3(half_size_ * dvec2(x, y), 1.0)));
    };
    DirectionCone cone{direction(0, 0), 1.f};
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, direction(x, y)));
      }
    }
    return cone;
  }

  LightImage image_;
  float scale_ = 1.f;     // of the image [W/sr]
  dvec2 half_size_{1.0};  // of the screen at depth 1
  glm::dmat3 to_render_{1.0}, to_light_{1.0};
  double determinant_ = 1.0;    // of to_render_
  double natural_power_ = 0.0;  // for scale 1, in luminance [W]
  Distribution2D distribution_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "projection", pssmlt::ProjectionLight)
