#include "core/principled_bsdf.h"

#include "core/base/warp.h"
#include "core/sheen.h"

namespace pssmlt {
namespace {

constexpr float coat_f0 = 0.04f;  // of an index of 1.5
constexpr int mean_points = 16;   // over directions

float fifth_power(float x) { return sqr(sqr(x)) * x; }
float grazing(float cosine) { return fifth_power(1.f - std::min(std::abs(cosine), 1.f)); }
vec3 flipped(const vec3& w) { return {w.x, w.y, -w.z}; }
vec3 half_vector(const vec3& wo, const vec3& wi) { return glm::normalize(wo + wi); }

float coat_fresnel(float cosine) { return coat_f0 + (1.f - coat_f0) * grazing(cosine); }

// f(wo, wi) [1/sr] without Fresnel, and the density of reflecting about a visible facet [1/sr].
float facet_value(const Ggx& ggx, const vec3& wo, const vec3& wi, const vec3& m) {
  return ggx.d(m) * ggx.visibility(wo, wi);
}
float facet_density(const Ggx& ggx, const vec3& wo, const vec3& m) {
  const float cosine = std::abs(glm::dot(wo, m));
  return cosine > 0.f ? ggx.pdf_visible(wo, m) / (4.f * cosine) : 0.f;
}

}  // namespace

PrincipledBsdf::PrincipledBsdf(const PrincipledPoint& p)
    : f0_(p.f0),
      sheen_(p.sheen),
      f0_most_(max_component(p.f0)),
      f90_(p.f90),
      eta_(p.eta),
      sheen_most_(max_component(p.sheen)),
      coat_(p.coat),
      sheen_roughness_(p.sheen_roughness),
      axis_(p.axis),
      // The narrower axis reflects more: energy is rather lost than gained.
      table_alpha_(std::min(p.alpha.x, p.alpha.y)),
      thin_(p.thin || p.eta == 1.f),
      smooth_(Ggx(p.alpha.x, p.alpha.y).is_smooth()),
      coat_smooth_(Ggx(p.coat_alpha, p.coat_alpha).is_smooth()),
      ggx_(p.alpha.x, p.alpha.y),
      coat_ggx_(p.coat_alpha, p.coat_alpha) {
  if (smooth_) table_alpha_ = 0.f;
  const float dielectric = 1.f - p.metallic;
  const float surface = thin_ ? dielectric : dielectric * (1.f - p.transmission);
  a_ = p.metallic * p.base + surface * p.f0;
  b_ = p.metallic * (1.f - p.base) + surface * (p.f90 - p.f0);
  glass_ = thin_ ? 0.f : dielectric * p.transmission;
  through_ = dielectric * p.transmission * p.base;
  through_most_ = thin_ ? max_component(through_) : glass_;
  diffuse_ = dielectric * (1.f - p.transmission) * p.base;
  diffuse_most_ = max_component(diffuse_);
  if (diffuse_most_ > 0.f) diffuse_ *= inv_pi / std::max(mean_reaching_base(), 1e-3f);
}

SchlickAlbedo PrincipledBsdf::surface_albedo(float mu) const {
  if (!smooth_) return GgxAlbedo::table().at(mu, table_alpha_);
  const float high = grazing(mu);
  return {1.f - high, high};
}

float PrincipledBsdf::past_coat(float mu) const {
  if (!(coat_ > 0.f)) return 1.f;
  if (coat_smooth_) return 1.f - coat_ * coat_fresnel(mu);
  return 1.f - coat_ * GgxAlbedo::table().at(mu, coat_ggx_.width())(coat_f0, 1.f);
}

float PrincipledBsdf::past_layers(float mu) const {
  float passed = past_coat(mu);
  if (sheen_most_ > 0.f) passed *= 1.f - sheen_most_ * Sheen::table().albedo(mu, sheen_roughness_);
  return passed;
}

float PrincipledBsdf::reaches_base(float mu) const {
  const float below = 1.f - surface_albedo(mu)(f0_most_, f90_);
  return has_layers() ? below * past_layers(mu) : below;
}

float PrincipledBsdf::mean_reaching_base() const {
  if (!has_layers() && !smooth_) return 1.f - GgxAlbedo::table().mean(table_alpha_)(f0_most_, f90_);
  // The integral of 2 mu (1 - mu)^5 is 1 / 21.
  if (!has_layers()) return 1.f - (f0_most_ * 20.f + f90_) / 21.f;
  float sum = 0.f;
  for (int i = 0; i < mean_points; ++i) {
    // Uniform in mu^2: weights are equal under a cosine.
    sum += reaches_base(std::sqrt((static_cast<float>(i) + 0.5f) / mean_points));
  }
  return sum / mean_points;
}

Rgb PrincipledBsdf::schlick(float cosine) const { return a_ + b_ * grazing(cosine); }
Rgb PrincipledBsdf::surface(float cosine) const { return f0_ + (f90_ - f0_) * grazing(cosine); }

PrincipledBsdf::Shares PrincipledBsdf::shares(const vec3& wo) const {
  const float mu = std::min(std::abs(wo.z), 1.f);
  const SchlickAlbedo split = surface_albedo(mu);
  const float coat = past_coat(mu), layers = past_layers(mu);
  const float below = 1.f - split(f0_most_, f90_);
  Shares s;
  s.coat = 1.f - coat;
  s.sheen = coat - layers;
  s.specular = layers * (split.low * max_component(a_) + split.high * max_component(a_ + b_));
  s.diffuse = layers * below * diffuse_most_;
  s.through = layers * (thin_ ? below : 1.f) * through_most_;
  const float sum = s.coat + s.sheen + s.specular + s.diffuse + s.through;
  if (!(sum > 0.f)) return {};
  const float scale = 1.f / sum;
  return {s.specular * scale, s.through * scale, s.diffuse * scale, s.coat * scale,
          s.sheen * scale};
}

Rgb PrincipledBsdf::same_side(const vec3& wo, const vec3& wi) const {
  const float mu_o = std::abs(wo.z), mu_i = std::abs(wi.z);
  const vec3 m = half_vector(wo, wi);
  const float cosine = glm::dot(wo, m);
  Rgb sum(0.f);
  float layers = 1.f;
  if (has_layers()) {
    layers = std::min(past_layers(mu_o), past_layers(mu_i));
    if (coat_ > 0.f && !coat_smooth_)
      sum += Rgb(coat_ * coat_fresnel(cosine) * facet_value(coat_ggx_, wo, wi, m));
    if (sheen_most_ > 0.f)
      sum += sheen_ * (std::min(past_coat(mu_o), past_coat(mu_i)) *
                       Sheen::table().value(wo, wi, sheen_roughness_));
  }
  if (!smooth_) sum += layers * facet_value(ggx_, wo, wi, m) * schlick(cosine);
  if (diffuse_most_ > 0.f) sum += diffuse_ * (reaches_base(mu_o) * reaches_base(mu_i));
  return sum;
}

Rgb PrincipledBsdf::thin_value(const vec3& wo, const vec3& wi) const {
  const vec3 back = flipped(wi), m = half_vector(wo, back);
  return through_ * (1.f - surface(glm::dot(wo, m))) * facet_value(ggx_, wo, back, m);
}

Rgb PrincipledBsdf::value(const vec3& wo, const vec3& wi, Transport mode) const {
  const bool reflects = wo.z * wi.z > 0.f;
  Rgb sum = reflects ? same_side(wo, wi) : Rgb(0.f);
  if (smooth_ || !(through_most_ > 0.f)) return sum;
  float layers = 1.f;
  if (has_layers()) layers = std::min(past_layers(std::abs(wo.z)), past_layers(std::abs(wi.z)));
  if (thin_) return reflects ? sum : layers * thin_value(wo, wi);
  const RoughInterface boundary(eta_, ggx_);
  if (const auto f = boundary.facet(wo, wi))
    sum += (reflects ? Rgb(glass_) : through_) * (layers * boundary.value(*f, wo, wi, mode));
  return sum;
}

float PrincipledBsdf::density(const vec3& wo, const vec3& wi) const {
  const Shares s = shares(wo);
  float sum = 0.f;
  if (wo.z * wi.z > 0.f) {
    const vec3 m = half_vector(wo, wi);
    sum += s.diffuse * std::abs(wi.z) * inv_pi + s.sheen * (0.5f * inv_pi);
    if (!smooth_) sum += s.specular * facet_density(ggx_, wo, m);
    if (!coat_smooth_ && s.coat > 0.f) sum += s.coat * facet_density(coat_ggx_, wo, m);
  } else if (thin_ && !smooth_) {
    sum += s.through * facet_density(ggx_, wo, half_vector(wo, flipped(wi)));
  }
  if (volume() && !smooth_) {
    const RoughInterface boundary(eta_, ggx_);
    if (const auto f = boundary.facet(wo, wi)) sum += s.through * boundary.density(wo, *f);
  }
  return sum;
}

std::optional<BsdfSample> PrincipledBsdf::mirrored(const vec3& wo, const Rgb& value,
                                                   float share) const {
  return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                    .weight = value / share,
                    .pdf = share,
                    .pdf_reverse = share,
                    .delta = true};
}

std::optional<BsdfSample> PrincipledBsdf::passed_thin(const vec3& wo, float share) const {
  const float layers = has_layers() ? past_layers(std::abs(wo.z)) : 1.f;
  return BsdfSample{.wi = -wo,
                    .weight = through_ * (1.f - surface(wo.z)) * (layers / share),
                    .pdf = share,
                    .pdf_reverse = share,
                    .delta = true,
                    .transmitted = true};
}

std::optional<BsdfSample> PrincipledBsdf::passed_smooth(const vec3& wo, float u, float share,
                                                        Transport mode) const {
  const float f = fresnel_dielectric(wo.z, eta_);
  const float layers = has_layers() ? past_layers(std::abs(wo.z)) : 1.f;
  if (u < f) {
    auto s = mirrored(wo, Rgb(layers * glass_ * f), share * f);
    return s;
  }
  const std::optional<Refraction> t = refract(wo, vec3(0.f, 0.f, 1.f), eta_);
  if (!t || !(wo.z * t->direction.z < 0.f)) return std::nullopt;
  const float passed = has_layers() ? std::min(layers, past_layers(std::abs(t->direction.z))) : 1.f;
  return BsdfSample{.wi = t->direction,
                    .weight = through_ * (passed * refracted_radiance_scale(t->eta, mode) / share),
                    .pdf = share * (1.f - f),
                    .pdf_reverse = shares(t->direction).through * (1.f - f),
                    .delta = true,
                    .transmitted = true,
                    .eta = t->eta};
}

std::optional<vec3> PrincipledBsdf::reflected(const Ggx& ggx, const vec3& wo, const vec2& u) const {
  const auto m = ggx.sample_visible(wo, u);
  if (!m) return std::nullopt;
  const vec3 wi = glm::normalize(reflect(wo, *m));
  if (!(wi.z * wo.z > 0.f)) return std::nullopt;
  return wi;
}

// Of the lobes that have a width; u_lobe falls into the share of one of them.
std::optional<vec3> PrincipledBsdf::direction(const Shares& s, const vec3& wo, float u_lobe,
                                              const vec2& u) const {
  if (u_lobe < s.specular) return reflected(ggx_, wo, u);
  u_lobe -= s.specular;
  if (u_lobe < s.through && thin_) {
    const auto back = reflected(ggx_, wo, u);
    return back ? std::optional(flipped(*back)) : std::nullopt;
  }
  if (u_lobe < s.through) {
    const float rest = std::min(u_lobe / s.through, one_minus_epsilon);
    const auto drawn = RoughInterface(eta_, ggx_).draw(wo, rest, u);
    return drawn ? std::optional(drawn->wi) : std::nullopt;
  }
  u_lobe -= s.through;
  if (u_lobe < s.coat) return reflected(coat_ggx_, wo, u);
  u_lobe -= s.coat;
  const vec3 up = u_lobe < s.sheen ? direction_at_height(1.f - u.x, u.y) : cosine_hemisphere(u);
  if (!(up.z > 0.f)) return std::nullopt;
  return vec3(up.x, up.y, std::copysign(up.z, wo.z));
}

std::optional<BsdfSample> PrincipledBsdf::sample_local(const vec3& wo, float u_lobe, const vec2& u,
                                                       Transport mode) const {
  const Shares s = shares(wo);
  const float mu = std::abs(wo.z);
  if (smooth_ && u_lobe < s.specular)
    return mirrored(wo, past_layers(mu) * schlick(wo.z), s.specular);
  const float after = u_lobe - s.specular;
  if (smooth_ && after >= 0.f && after < s.through)
    return thin_ ? passed_thin(wo, s.through)
                 : passed_smooth(wo, after / s.through, s.through, mode);
  const float at_coat = after - s.through;
  if (coat_smooth_ && at_coat >= 0.f && at_coat < s.coat)
    return mirrored(wo, Rgb(coat_ * coat_fresnel(wo.z)), s.coat);
  const std::optional<vec3> wi = direction(s, wo, u_lobe, u);
  if (!wi || wi->z == 0.f) return std::nullopt;
  BsdfSample sample;
  sample.wi = *wi;
  sample.pdf = density(wo, *wi);
  if (!(sample.pdf > 0.f)) return std::nullopt;
  sample.pdf_reverse = density(*wi, wo);
  sample.weight = value(wo, *wi, mode) * (std::abs(wi->z) / sample.pdf);
  sample.transmitted = wo.z * wi->z < 0.f;
  if (sample.transmitted && volume()) sample.eta = wo.z > 0.f ? eta_ : 1.f / eta_;
  return sample;
}

namespace {

vec3 turned(const vec3& w, const vec2& axis) {
  return {axis.x * w.x + axis.y * w.y, axis.x * w.y - axis.y * w.x, w.z};
}

}  // namespace

Rgb PrincipledBsdf::eval(const vec3& wo, const vec3& wi, Transport mode) const {
  if (wo.z == 0.f || wi.z == 0.f) return Rgb(0.f);
  return value(turned(wo, axis_), turned(wi, axis_), mode);
}

float PrincipledBsdf::pdf(const vec3& wo, const vec3& wi) const {
  if (wo.z == 0.f || wi.z == 0.f) return 0.f;
  return density(turned(wo, axis_), turned(wi, axis_));
}

std::optional<BsdfSample> PrincipledBsdf::sample(const vec3& wo, float u_lobe, const vec2& u,
                                                 Transport mode) const {
  if (wo.z == 0.f) return std::nullopt;
  auto s = sample_local(turned(wo, axis_), u_lobe, u, mode);
  if (s) s->wi = turned(s->wi, {axis_.x, -axis_.y});
  return s;
}

bool PrincipledBsdf::connectible() const {
  return !smooth_ || diffuse_most_ > 0.f || sheen_most_ > 0.f || (coat_ > 0.f && !coat_smooth_);
}

Rgb PrincipledBsdf::albedo(const vec3& wo) const {
  const float mu = std::min(std::abs(wo.z), 1.f);
  const SchlickAlbedo split = surface_albedo(mu);
  const float layers = past_layers(mu);
  Rgb sum = Rgb(1.f - layers) + layers * (split.low * a_ + split.high * (a_ + b_));
  if (diffuse_most_ > 0.f) {
    const float mean = mean_reaching_base();
    sum += diffuse_ * (pi * reaches_base(mu) * mean);
  }
  return sum + layers * (thin_ ? 1.f - split(f0_most_, f90_) : 1.f) * through_;
}

}  // namespace pssmlt
