// A shape whose surface emits the same radiance in all directions, from its outside or from both
// sides, constant or textured: by an image over (u, v), or by any texture (an extension of the
// format).
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.4. "power" is the
// flux of the whole shape (of all triangles of a mesh together) and replaces the magnitude of L.
// Points are chosen over the area: large lights seen from near are noisy.
#include <algorithm>
#include <glm/common.hpp>

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/image/image.h"
#include "core/light.h"
#include "core/plugin/plugin.h"
#include "core/shape.h"
#include "core/texture.h"

namespace pssmlt {
namespace {

SurfaceSample as_sample(const EndpointPoint& at) {
  return {.position = at.position, .normal = at.normal, .uv = at.uv, .element = at.element};
}
EndpointPoint as_point(const SurfaceSample& s) { return {s.position, s.normal, s.uv, s.element}; }
Hit as_hit(const EndpointPoint& at) {
  Hit hit;
  hit.position = at.position;
  hit.ng = hit.ns = at.normal;
  hit.uv = at.uv;
  hit.element = at.element;
  return hit;
}

class DiffuseAreaLight final : public Light {
 public:
  static constexpr const char* summary = "Shape that emits the same radiance in all directions";

  DiffuseAreaLight(Parameters& p, const PluginArguments& arguments)
      : shape_(arguments.shape), alpha_(arguments.alpha) {
    const bool has_radiance = p.has("L");
    const auto radiance = p.rgb_texture("L", Rgb(1.f), SpectrumUse::Illuminant, "W/(m^2 sr)",
                                        "Emitted radiance; a texture may vary it.");
    const float scale = p.number("scale", 1.f, "", "Factor of the radiance.");
    const float power = p.number("power", -1.f, "W", "Total emitted power; negative: from L.");
    two_sided_ = p.flag("twosided", false, "Emit from the inside as well.");
    const std::string file = p.file("filename", "Image of radiance over (u, v).");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (has_radiance && !file.empty())
      p.fail("filename", "\"filename\" cannot be given together with \"L\"");
    if (p.describing()) return;
    // Cut out everywhere: the shape is not seen, but emits in full, as in pbrt-v4.
    hidden_ = alpha_ && alpha_->constant() && alpha_->evaluate(Hit()) == 0.f;
    if (hidden_) alpha_ = nullptr;
    if (!file.empty()) load(p, file);
    area_ = shape_->area();
    if (radiance->constant()) {
      radiance_ = radiance->evaluate(Hit());
    } else {
      texture_ = radiance;
      measure_texture();
    }
    radiance_ *= scale;
    if (power > 0.f) radiance_ *= power / natural_power(p);
  }

  EndpointTraits traits() const override { return {.hidden = hidden_}; }
  float power() const override {
    return sides() * pi * area_ * luminance(radiance_) * mean_luminance_;
  }

  std::optional<LightBounds> bounds() const override {
    LightBounds b;
    b.box = shape_->bounds();
    b.normals = shape_->normals();
    b.two_sided = two_sided_;
    b.intensity = power() / (sides() * pi);
    return b;
  }

  // The first direction number also picks the side of two-sided lights.
  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const SurfaceSample s = shape_->sample_area(u_position);
    if (!(s.pdf > 0.f)) return std::nullopt;
    const bool inside = two_sided_ && u_direction.x < 0.5;
    const double x = two_sided_ ? 2.0 * u_direction.x - (inside ? 0.0 : 1.0) : u_direction.x;
    vec3 local = cosine_hemisphere(to_float_below_one({x, u_direction.y}));
    if (inside) local.z = -local.z;
    Emission e;
    e.from = as_point(s);
    e.error = s.error;
    e.direction = glm::normalize(Frame(s.normal).to_world(local));
    const EmissionValue v = evaluate(e.from, e.direction, s.pdf);
    e.value = opacity(e.from) * v.value;
    e.cosine = v.cosine;
    e.pdf_position = v.pdf_position;
    e.pdf_direction = v.pdf_direction;
    if (is_black(e.value) || !(e.pdf_direction > 0.f)) return std::nullopt;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    if (!two_sided_ && !shape_->may_face(reference)) return std::nullopt;
    const auto s = shape_->sample_toward(reference, u);
    if (!s) return std::nullopt;
    Toward t;
    t.at = as_point(*s);
    const vec3 d = s->position - reference;
    t.distance = glm::length(d);
    if (!(t.distance > 0.f)) return std::nullopt;
    t.error = s->error;
    t.wi = d / t.distance;
    const EmissionValue v = evaluate(t.at, -t.wi, shape_->pdf_area(*s));
    t.value = opacity(t.at) * v.value;
    if (is_black(t.value)) return std::nullopt;
    t.pdf_toward = s->pdf;
    t.cosine = v.cosine;
    t.pdf_position = v.pdf_position;
    t.pdf_direction = v.pdf_direction;
    return t;
  }

  // Of a surface that is there: rays meet a cut-out with its opacity as probability already, while
  // emit() and toward(), which choose points whether they are there or not, weight by it.
  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const override {
    return evaluate(at, direction, shape_->pdf_area(as_sample(at)));
  }
  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    return shape_->pdf_toward(reference, as_sample(at));
  }

 private:
  float sides() const { return two_sided_ ? 2.f : 1.f; }

  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction, float pdf_position) const {
    const float z = glm::dot(at.normal, direction);
    const float cosine = std::abs(z);
    if (!two_sided_ && !(z > 0.f)) return {Rgb(0.f), cosine, pdf_position, 0.f};
    return {texture_ ? radiance_ * textured(at) : radiance(at.uv), cosine, pdf_position,
            cosine * inv_pi / sides()};
  }

  static Image read(const Parameters& p, const std::string& file) {
    try {
      return read_image(file, "");
    } catch (const Error& e) {
      p.fail("filename", e.what());
    }
  }
  void load(const Parameters& p, const std::string& file) {
    image_ = read(p, file);
    if (image_.width == 0 || image_.height == 0) p.fail("filename", "'" + file + "' is empty");
    double sum = 0.0;
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        if (!is_finite(raw(x, y)))
          p.fail("filename", "'" + file + "' has pixels that are not finite numbers");
        sum += static_cast<double>(luminance(texel(x, y)));
      }
    mean_luminance_ = static_cast<float>(sum / image_.width / image_.height);
  }

  // The mean luminance, from points spread evenly over the shape: it guides the choice among
  // lights.
  void measure_texture() {
    constexpr int points = 1024;
    double sum = 0.0;
    // Roberts's sequence: multiples of the inverse powers of the plastic number.
    dvec2 u(0.5);
    for (int i = 0; i < points; ++i) {
      u += dvec2(0.7548776662466927, 0.5698402909980532);
      u -= glm::floor(u);
      sum += static_cast<double>(
          luminance(textured(as_point(shape_->sample_area(to_float_below_one(u))))));
    }
    mean_luminance_ = static_cast<float>(sum / points);
    // What no point met may still shine.
    if (!(mean_luminance_ > 1e-3f)) mean_luminance_ = 1e-3f;
  }
  Rgb textured(const EndpointPoint& at) const {
    return glm::max(texture_->evaluate(as_hit(at)), Rgb(0.f));
  }

  // Power [W] of a light whose white has unit radiance: colours of L do not count.
  float natural_power(const Parameters& p) const {
    const float power = sides() * pi * area_ * mean_luminance_;
    if (!(power > 0.f)) p.fail("power", "the shape has no area, or the image is black");
    return power;
  }

  Rgb raw(int x, int y) const {
    const float* const c = image_.pixel(x, y);
    return image_.channels < 3 ? Rgb(c[0]) : Rgb(c[0], c[1], c[2]);
  }
  Rgb texel(int x, int y) const {
    return glm::max(raw(std::clamp(x, 0, image_.width - 1), std::clamp(y, 0, image_.height - 1)),
                    Rgb(0.f));
  }
  // Bilinear over the image, whose lower left corner is (0, 0); edges continue.
  Rgb radiance(const vec2& uv) const {
    if (image_.width == 0) return radiance_;
    const auto coordinate = [](float t, int n) {
      return std::fmin(std::fmax(t, 0.f), 1.f) * static_cast<float>(n) - 0.5f;
    };
    const float x = coordinate(uv.x, image_.width), y = coordinate(1.f - uv.y, image_.height);
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    const float dx = x - static_cast<float>(ix), dy = y - static_cast<float>(iy);
    return radiance_ * ((1.f - dy) * ((1.f - dx) * texel(ix, iy) + dx * texel(ix + 1, iy)) +
                        dy * ((1.f - dx) * texel(ix, iy + 1) + dx * texel(ix + 1, iy + 1)));
  }
  float opacity(const EndpointPoint& at) const {
    if (!alpha_) return 1.f;
    const float a = alpha_->evaluate(as_hit(at));
    return a < 0.f ? 0.f : a > 1.f ? 1.f : a;  // NaN, a texture's failure, passes and is counted
  }

  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const Texture<float>> alpha_;
  std::shared_ptr<const Texture<Rgb>> texture_;  // of the radiance, null if that is constant
  Rgb radiance_{1.f};                            // [W/(m^2 sr)], or the image's or texture's factor
  bool two_sided_ = false;
  bool hidden_ = false;  // rays pass through the shape
  Image image_;
  float area_ = 0.f;            // [m^2]
  float mean_luminance_ = 1.f;  // of the image
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(AreaLight, "diffuse", pssmlt::DiffuseAreaLight)
