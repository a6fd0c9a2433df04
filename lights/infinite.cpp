// Light from all around: the same radiance from everywhere, or an image that surrounds the scene.
//
// Images are square equal-area maps of the sphere (Clarberg 2008, Fast Equal-Area Mapping of the
// (Hemi)Sphere Using SIMD) or, by "mapping", maps of longitude and latitude; they are looked up
// without interpolation and sampled exactly in proportion to their luminance (Pharr, Jakob,
// Humphreys 2023, Physically Based Rendering, section 12.5). "illuminance" is what a horizontal
// surface (normal +z of the light's space) receives of constant light. A "portal" guides what is
// drawn toward points inside a room (core/portal.h); light that comes another way is found as well.
// Rays from the light know no portal.
#include <algorithm>
#include <array>

#include "core/light_infinite.h"
#include "core/plugin/plugin.h"
#include "core/portal.h"
#include "core/sphere_map.h"

namespace pssmlt {
namespace {

// Of the directions drawn toward points that see a portal, the share that ignores it.
constexpr float free_share = 0.125f;

class InfiniteLight final : public Light {
 public:
  static constexpr const char* summary = "Light from all around, constant or an image";

  explicit InfiniteLight(Parameters& p) {
    const bool has_radiance = p.has("L");
    radiance_ = p.rgb("L", Rgb(1.f), SpectrumUse::Illuminant, "W/(m^2 sr)", "Constant radiance.");
    const float scale = p.number("scale", 1.f, "", "Factor of the radiance.");
    const std::string file = p.file("filename", "Image of radiance, a map of the sphere.");
    const SphereMapping mapping = read_sphere_mapping(p);
    const float illuminance = p.number("illuminance", -1.f, "W/m^2",
                                       "What the horizon's upper side gives; negative: as is.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    const std::vector<vec3> portal =
        p.points3("portal", "m",
                  "Corners of a rectangle, in world space, through which a room sees the sky.");
    if (p.has("portal") && portal.size() != 4)
      p.fail("portal", "\"portal\" needs four points, the corners of a rectangle");
    if (p.describing()) return;
    if (has_radiance && !file.empty())
      p.fail("filename", "\"filename\" cannot be given together with \"L\"");
    if (!file.empty())
      map_ = SphereMap(read_sphere_image(p, file, mapping), mapping,
                       glm::dmat3(p.transform().matrix()));
    if (!portal.empty()) make_portal(p, portal);
    radiance_ *= scale;
    if (illuminance > 0.f) radiance_ *= illuminance / natural_illuminance(p);
  }

  EndpointTraits traits() const override { return {.infinite = true}; }
  void prepare(const SceneBounds& bounds) override { disk_.set(bounds); }
  float power() const override {
    return 4.f * pi * disk_.area() * luminance(radiance_) * (map_.empty() ? 1.f : map_.mean());
  }

  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const auto d = sample_direction(u_direction);
    if (!d) return std::nullopt;
    Emission e;
    e.direction = -d->direction;
    e.from = disk_.sample(e.direction, u_position);
    e.value = background(d->direction);
    e.pdf_position = disk_.pdf();
    e.pdf_direction = d->pdf;
    return e;
  }
  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    const auto view = portal_ ? portal_->view(reference) : std::nullopt;
    const auto direction = draw_toward(view, u);
    if (!direction) return std::nullopt;
    Toward t;
    t.at.normal = -*direction;
    t.wi = *direction;
    t.distance = infinity;
    t.value = background(*direction);
    t.pdf_toward = density_toward(view, t.wi);
    t.pdf_position = disk_.pdf();
    t.pdf_direction = pdf(*direction);
    return t;
  }
  EmissionValue evaluate(const EndpointPoint&, const vec3& direction) const override {
    return {background(-direction), 1.f, disk_.pdf(), pdf(-direction)};
  }
  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    return density_toward(portal_ ? portal_->view(reference) : std::nullopt, -at.normal);
  }

  Rgb background(const vec3& direction) const override {
    return map_.empty() ? radiance_ : radiance_ * map_.value(direction);
  }

 private:
  // Illuminance [W/m^2] of the light of scale 1. For equal-area images pbrt-v4 sums the upper
  // hemisphere with half the solid angle of each pixel; scenes made for it count on that.
  float natural_illuminance(const Parameters& p) const {
    if (map_.empty()) return pi;
    const LightImage& image = map_.image();
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double z = map_.direction({(x + 0.5) / image.width, (y + 0.5) / image.height}).z;
        const Rgb seen = image.at(x, y) * map_.row_weight(y);
        if (z > 0.0) sum += z * static_cast<double>(luminance(seen));
      }
    if (!(sum > 0.0)) p.fail("illuminance", "the image's upper hemisphere is black");
    const double all = (map_.equal_area() ? 2.0 : 4.0) * std::numbers::pi;
    return static_cast<float>(sum * all / image.width / image.height);
  }

  void make_portal(const Parameters& p, const std::vector<vec3>& points) {
    std::array<dvec3, 4> corners;
    for (size_t i = 0; i < 4; ++i) corners[i] = p.world().point(dvec3(points[i]));
    const int size = map_.empty() ? 64 : std::clamp(map_.image().width, 64, 1024);
    const auto sky = [&](const vec3& d) { return luminance(background(d)); };
    portal_ = Portal::make(corners, sky, size);
    if (!portal_) p.fail("portal", "the four points of \"portal\" make no rectangle");
  }

  using View = std::optional<Portal::View>;  // nullopt: no portal to be guided by
  std::optional<vec3> draw_toward(const View& view, vec2 u) const {
    if (view && u.x >= free_share) {
      u.x = std::min((u.x - free_share) / (1.f - free_share), one_minus_epsilon);
      return portal_->sample(*view, u);
    }
    if (view) u.x /= free_share;
    const auto drawn = sample_direction(dvec2(u));
    return drawn ? std::optional(drawn->direction) : std::nullopt;
  }
  // Its density [1/sr at the reference].
  float density_toward(const View& view, const vec3& direction) const {
    if (!view) return pdf(direction);
    return free_share * pdf(direction) + (1.f - free_share) * portal_->pdf(*view, direction);
  }
  // Proportional to luminance; over the whole sphere for constant light.
  std::optional<SphereMap::Sample> sample_direction(const dvec2& u) const {
    if (!map_.empty()) return map_.sample(u);
    return SphereMap::Sample{uniform_sphere(to_float_below_one(u)), 0.25f * inv_pi};
  }
  // Density of sample_direction [1/sr].
  float pdf(const vec3& toward) const { return map_.empty() ? 0.25f * inv_pi : map_.pdf(toward); }

  EntryDisk disk_;
  Rgb radiance_{1.f};  // [W/(m^2 sr)], or the image's factor
  SphereMap map_;      // empty: constant
  std::optional<Portal> portal_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "infinite", pssmlt::InfiniteLight)
