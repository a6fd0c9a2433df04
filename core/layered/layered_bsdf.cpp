#include "core/layered/layered_bsdf.h"

#include <cmath>
#include <tuple>

#include "core/base/warp.h"

namespace pssmlt {
namespace {

// Of what the base reflects: drawn from the lobe that metal shows, from one twice as wide (for
// light that was reflected more than once), and from a cosine.
struct Shares {
  float lobe = 0.f, wide = 0.f;
};
Shares shares(const LayerBase& base, const LayerMedium& medium) {
  if (base.lambertian) return {};
  return medium.scatters() ? Shares{0.5f, 0.1f} : Shares{0.8f, 0.15f};
}

// Mirrored facets of a lobe on wo's side.
float facet_density(const Ggx& ggx, const vec3& wo, const vec3& wi) {
  const vec3 h = wo + wi;
  const float l2 = length_squared(h);
  if (!(l2 > 0.f)) return 0.f;
  const vec3 m = h / std::sqrt(l2);
  return ggx.pdf_visible(wo, m) / (4.f * std::abs(glm::dot(wo, m)));
}
std::optional<vec3> facet_mirror(const Ggx& ggx, const vec3& wo, const vec2& u) {
  const auto m = ggx.sample_visible(wo, u);
  if (!m) return std::nullopt;
  const vec3 wi = glm::normalize(reflect(wo, *m));
  if (!(wi.z > 0.f)) return std::nullopt;
  return wi;
}

// Any order that does not depend on which of the two is wo.
bool before(const vec3& a, const vec3& b) {
  return std::tie(a.z, a.x, a.y) < std::tie(b.z, b.x, b.y);
}

vec3 up(const vec3& w) { return {w.x, w.y, std::abs(w.z)}; }

}  // namespace

LayeredBsdf::LayeredBsdf(const LayerMedium& medium, const Ggx& boundary, const LayerBase& base,
                         const MaterialNumbers& u)
    : medium_(medium), boundary_(boundary), base_(base), numbers_(u, medium.events + 2) {}

Ggx LayeredBsdf::seen_lobe() const {
  // Widths of half vectors outside: the base's lobe spreads by the index on its way out; a facet
  // of the boundary turns what it refracts, twice, by its tilt times (eta - 1) / 2.
  const float turned = smooth() ? 0.f : 0.5f * sqr((medium_.eta - 1.f) * boundary_.width());
  const float own = sqr(medium_.eta * base_.metal.ggx().width());
  const float width = std::clamp(std::sqrt(own + turned), 2.f * Ggx::smooth_below, 1.f);
  return {width, width};
}

float LayeredBsdf::coat_probability(const vec3& wo) const {
  if (medium_.eta == 1.f) return 0.f;
  const float coat = fresnel_dielectric(std::abs(wo.z), medium_.eta);
  const Rgb below = base_.lambertian ? base_.reflectance : base_.metal.fresnel()(wo.z);
  const float rest = std::max(max_component(below), max_component(medium_.albedo));
  return coat / (coat + (1.f - coat) * std::max(rest, 0.1f));
}

Rgb LayeredBsdf::albedo(const vec3& wo) const {
  const float coat = fresnel_dielectric(std::abs(wo.z), medium_.eta);
  const Rgb below = base_.lambertian ? base_.reflectance : base_.metal.fresnel()(wo.z);
  return Rgb(coat) + (1.f - coat) * below;
}

Rgb LayeredBsdf::eval(const vec3& wo, const vec3& wi, Transport) const {
  if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
  const vec3 a = up(wo), b = up(wi);
  const LayerWalk walk(medium_, boundary_, base_);
  Rgb f = before(a, b) ? walk.estimate(a, b, numbers_) : walk.estimate(b, a, numbers_);
  if (smooth()) return f;
  const vec3 h = glm::normalize(a + b);
  return f + fresnel_dielectric(glm::dot(a, h), medium_.eta) * boundary_.d(h) *
                 boundary_.visibility(a, b);
}

float LayeredBsdf::pdf(const vec3& wo, const vec3& wi) const {
  if (!(wo.z * wi.z > 0.f)) return 0.f;
  const vec3 a = up(wo), b = up(wi);
  const float coat = coat_probability(wo);
  const Shares share = shares(base_, medium_);
  float rest = (1.f - share.lobe - share.wide) * b.z * inv_pi;
  if (share.lobe > 0.f) {
    const Ggx lobe = seen_lobe();
    const float wide = std::min(2.f * lobe.width(), 1.f);
    rest +=
        share.lobe * facet_density(lobe, a, b) + share.wide * facet_density(Ggx(wide, wide), a, b);
  }
  return (1.f - coat) * rest + (smooth() ? 0.f : coat * facet_density(boundary_, a, b));
}

// u_lobe in [0, 1) over what is not a delta lobe, scaled by coat_probability() first.
std::optional<vec3> LayeredBsdf::draw(const vec3& wo, float u_lobe, const vec2& u) const {
  const vec3 a = up(wo);
  const float coat = coat_probability(wo);
  if (u_lobe < coat) return facet_mirror(boundary_, a, u);
  const float rest = (u_lobe - coat) / (1.f - coat);
  const Shares share = shares(base_, medium_);
  if (rest < share.lobe) return facet_mirror(seen_lobe(), a, u);
  if (rest < share.lobe + share.wide) {
    const float wide = std::min(2.f * seen_lobe().width(), 1.f);
    return facet_mirror(Ggx(wide, wide), a, u);
  }
  const vec3 wi = cosine_hemisphere(u);
  return wi.z > 0.f ? std::optional(wi) : std::nullopt;
}

std::optional<BsdfSample> LayeredBsdf::sample(const vec3& wo, float u_lobe, const vec2& u,
                                              Transport mode) const {
  if (wo.z == 0.f) return std::nullopt;
  const float coat = coat_probability(wo);
  if (smooth() && u_lobe < coat) {
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                      .weight = Rgb(fresnel_dielectric(std::abs(wo.z), medium_.eta) / coat),
                      .pdf = coat,
                      .pdf_reverse = coat,
                      .delta = true};
  }
  const auto drawn = draw(wo, u_lobe, u);
  if (!drawn) return std::nullopt;
  BsdfSample s;
  s.wi = {drawn->x, drawn->y, std::copysign(drawn->z, wo.z)};
  s.pdf = pdf(wo, s.wi);
  if (!(s.pdf > 0.f)) return std::nullopt;
  s.pdf_reverse = pdf(s.wi, wo);
  s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf);
  return s;
}

// F + (1 - F)^2 R A^2 / (1 - F R A^2): the series of reflections between boundary and base.
Rgb LayeredMirrorBsdf::albedo(const vec3& wo) const {
  const float mu = std::abs(wo.z);
  const float f = fresnel_dielectric(mu, medium_.eta);
  const auto t = refract({safe_sqrt(1.f - mu * mu), 0.f, mu}, {0.f, 0.f, 1.f}, medium_.eta);
  if (!t || !(t->direction.z < 0.f)) return Rgb(f);
  const float cosine = -t->direction.z;
  const float passed = std::exp(-2.f * medium_.thickness / cosine);
  const Rgb below = base_(cosine) * passed;
  return Rgb(f) + sqr(1.f - f) * below / (1.f - f * below);
}

std::optional<BsdfSample> LayeredMirrorBsdf::sample(const vec3& wo, float, const vec2&,
                                                    Transport) const {
  if (wo.z == 0.f) return std::nullopt;
  return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                    .weight = albedo(wo),
                    .pdf = 1.f,
                    .pdf_reverse = 1.f,
                    .delta = true};
}

const Bsdf* make_layered_bsdf(const LayerMedium& medium, const Ggx& boundary, LayerBase base,
                              const MaterialNumbers& u, BsdfStorage& storage) {
  const bool smooth = refracts_sharply(medium.eta, boundary);
  if (smooth && base.is_delta()) {
    if (!medium.scatters()) return storage.make<LayeredMirrorBsdf>(medium, base.metal.fresnel());
    // What the medium sends to a mirror under a smooth boundary could not be joined with a
    // direction above; a lobe of the least width can.
    base.metal = {base.metal.fresnel(), Ggx(Ggx::smooth_below, Ggx::smooth_below)};
  }
  return storage.make<LayeredBsdf>(medium, boundary, base, u);
}

}  // namespace pssmlt
