#include "core/hair_bsdf.h"

#include <algorithm>

#include "core/color/fresnel.h"

namespace pssmlt {
namespace {

float power(float x, int n) {
  float result = 1.f;
  for (; n > 0; n /= 2, x *= x)
    if (n % 2 == 1) result *= x;
  return result;
}

// exp(-|x|) I_0(x), the modified Bessel function of the first kind (Abramowitz and Stegun 9.8.1,
// 9.8.2), to 2e-7.
float scaled_bessel(float x) {
  x = std::abs(x);
  if (x < 3.75f) {
    const float t = sqr(x / 3.75f);
    return std::exp(-x) *
           (1.f +
            t * (3.5156229f +
                 t * (3.0899424f +
                      t * (1.2067492f + t * (0.2659732f + t * (0.0360768f + t * 0.0045813f))))));
  }
  const float t = 3.75f / x;
  const float series =
      0.39894228f +
      t * (0.01328592f +
           t * (0.00225319f +
                t * (-0.00157565f +
                     t * (0.00916281f +
                          t * (-0.02057706f +
                               t * (0.02635537f + t * (-0.01647633f + t * 0.00392377f)))))));
  return series / std::sqrt(x);
}

// M_p: the distribution of theta_i, whose integral with cos(theta_i) is 1 (d'Eon et al. 2011,
// eq. 7), written so that nothing overflows for narrow lobes.
float longitudinal(float cosine_i, float cosine_o, float sine_i, float sine_o, float v) {
  const float a = cosine_i * cosine_o / v, b = sine_i * sine_o / v;
  // 2 sinh(1/v) exp(-1/v)
  const float width = -std::expm1(-2.f / v);
  return std::exp(a - b - 1.f / v) * scaled_bessel(a) / (v * width);
}

// The logistic distribution of scale s, cut off at +-pi, and a sample of it.
float logistic_cdf(float x, float s) { return 1.f / (1.f + std::exp(-x / s)); }
float trimmed_logistic(float x, float s) {
  const float e = std::exp(-std::abs(x) / s);
  return e / (s * sqr(1.f + e) * (2.f * logistic_cdf(pi, s) - 1.f));
}
float sample_trimmed_logistic(float u, float s) {
  // By symmetry about 0, where the small tail keeps its digits.
  const float tail = logistic_cdf(-pi, s);
  const float y = 0.5f - std::abs(u - 0.5f);  // in (0, 1/2]
  const float c = tail + y * (1.f - 2.f * tail);
  const float x = std::min(s * std::log((1.f - c) / c), pi);
  return u < 0.5f ? -x : x;
}

// The same angle in [-pi, pi].
float wrapped(float angle) { return std::remainder(angle, 2.f * pi); }

// Not the luminance, which leaves blue light in a few samples of large weight.
float mean_of(const Rgb& c) { return (c.x + c.y + c.z) * (1.f / 3.f); }

float variance_root(float beta) {
  return 0.726f * beta + 0.812f * sqr(beta) + 3.7f * power(beta, 20);
}

}  // namespace

Rgb hair_absorption(float eumelanin, float pheomelanin) {
  return eumelanin * Rgb(0.419f, 0.697f, 1.37f) + pheomelanin * Rgb(0.187f, 0.4f, 1.05f);
}

Rgb hair_absorption(const Rgb& c, float beta_n) {
  const float b = beta_n;
  const float fit = 5.969f - 0.215f * b + 2.532f * sqr(b) - 10.73f * power(b, 3) +
                    5.574f * power(b, 4) + 0.245f * power(b, 5);
  // Black would take an infinite absorption: the darkest is what a float's products still tell.
  const Rgb root = glm::log(glm::max(c, Rgb(1e-12f))) / fit;
  return root * root;
}

HairBsdf::HairBsdf(const HairPoint& p)
    : h_(std::clamp(p.h, -1.f, 1.f)), gamma_(std::asin(h_)), eta_(p.eta), sigma_a_(p.sigma_a) {
  // Chiang et al. 2016, eq. 7 and 8, and section 4.1.
  const float v = sqr(variance_root(p.beta_m));
  v_ = {v, 0.25f * v, 4.f * v, 4.f * v};
  const float b = p.beta_n;
  s_ = std::sqrt(pi / 8.f) * (0.265f * b + 1.194f * sqr(b) + 5.372f * power(b, 22));
  for (size_t k = 0; k < 3; ++k) {
    const float angle = p.alpha * static_cast<float>(1u << k);
    sine_scales_[k] = std::sin(angle);
    cosine_scales_[k] = std::cos(angle);
  }
}

// A_p: Fresnel's reflectance at every meeting with the surface, absorption on every crossing.
void HairBsdf::attenuate(Entry& e, float h) const {
  const float fresnel = fresnel_dielectric(e.cosine * safe_sqrt(1.f - h * h), eta_);
  // Across the fibre it refracts as a circle of this index (Marschner et al. 2003, appendix B).
  const float across = std::sqrt(std::max(sqr(eta_) - sqr(e.sine), 0.f));
  const float sine_t = across > 0.f ? std::clamp(h * e.cosine / across, -1.f, 1.f) : 0.f;
  e.gamma_t = std::asin(sine_t);
  const float cosine_theta_t = safe_sqrt(1.f - sqr(e.sine / eta_));
  const float length = cosine_theta_t > 0.f ? 2.f * safe_sqrt(1.f - sqr(sine_t)) / cosine_theta_t
                                            : 0.f;  // of one crossing, in radii
  const Rgb left = glm::exp(-sigma_a_ * length);
  auto& a = e.attenuation;
  a[0] = Rgb(fresnel);
  a[1] = sqr(1.f - fresnel) * left;
  a[2] = a[1] * left * fresnel;
  a[3] = fresnel < 1.f ? a[2] * fresnel * left / (Rgb(1.f) - left * fresnel) : Rgb(0.f);
}

// The scales turn R by -2 alpha, TT by alpha and TRT by 4 alpha (Marschner et al. 2003, table 1).
void HairBsdf::tilt(Entry& e) const {
  constexpr std::array<size_t, 3> scale = {1, 0, 2};
  for (size_t p = 0; p < 3; ++p) {
    const float c = cosine_scales_[scale[p]];
    const float s = p == 0 ? -sine_scales_[scale[p]] : sine_scales_[scale[p]];
    e.sine_tilted[p] = e.sine * c + e.cosine * s;
    e.cosine_tilted[p] = std::abs(e.cosine * c - e.sine * s);
  }
  e.sine_tilted[3] = e.sine;
  e.cosine_tilted[3] = e.cosine;
}

HairBsdf::Entry HairBsdf::enter(const vec3& wo) const {
  Entry e;
  e.sine = std::clamp(wo.x, -1.f, 1.f);
  e.cosine = std::sqrt(sqr(wo.y) + sqr(wo.z));
  e.phi = std::atan2(wo.z, wo.y);
  const float side = wo.z < 0.f ? -1.f : 1.f;
  e.gamma_o = side * gamma_;
  attenuate(e, side * h_);
  tilt(e);
  float sum = 0.f;
  for (size_t p = 0; p < lobes; ++p) sum += e.probability[p] = mean_of(e.attenuation[p]);
  const float inverse = sum > 0.f ? 1.f / sum : 0.f;
  for (float& p : e.probability) p *= inverse;
  return e;
}

float HairBsdf::exit_azimuth(const Entry& e, size_t p) {
  const auto n = static_cast<float>(p);
  return 2.f * n * e.gamma_t - 2.f * e.gamma_o + n * pi;
}

float HairBsdf::lobe(const Entry& e, size_t p, const vec3& wi) const {
  const float cosine_i = std::sqrt(sqr(wi.y) + sqr(wi.z));
  const float m = longitudinal(cosine_i, e.cosine_tilted[p], wi.x, e.sine_tilted[p], v_[p]);
  if (p + 1 == lobes) return m / (2.f * pi);
  const float phi = std::atan2(wi.z, wi.y) - e.phi;
  return m * trimmed_logistic(wrapped(phi - exit_azimuth(e, p)), s_);
}

Rgb HairBsdf::scattered(const Entry& e, const vec3& wi) const {
  Rgb sum(0.f);
  for (size_t p = 0; p < lobes; ++p)
    if (!is_black(e.attenuation[p])) sum += e.attenuation[p] * lobe(e, p, wi);
  return sum;
}

float HairBsdf::density(const Entry& e, const vec3& wi) const {
  float sum = 0.f;
  for (size_t p = 0; p < lobes; ++p)
    if (e.probability[p] > 0.f) sum += e.probability[p] * lobe(e, p, wi);
  return sum;
}

Rgb HairBsdf::eval(const vec3& wo, const vec3& wi, Transport mode) const {
  const bool forward = mode == Transport::radiance;
  const vec3 &camera = forward ? wo : wi, &light = forward ? wi : wo;
  if (camera.z == 0.f || light.z == 0.f) return Rgb(0.f);
  return scattered(enter(camera), light) / std::abs(light.z);
}

float HairBsdf::pdf(const vec3& wo, const vec3& wi) const { return density(enter(wo), wi); }

vec3 HairBsdf::direction(const Entry& e, size_t p, float turn, const vec2& u) const {
  // d'Eon et al. 2013, Importance Sampling for Physically-Based Hair Fiber Models, eq. 6 and 7.
  const float v = v_[p];
  const float x = std::max(u.x, 0x1p-25f);
  const float cosine = std::max(1.f + v * std::log(x + (1.f - x) * std::exp(-2.f / v)), -1.f);
  const float sine_i =
      std::clamp(-cosine * e.sine_tilted[p] + safe_sqrt(1.f - cosine * cosine) *
                                                  std::cos(2.f * pi * turn) * e.cosine_tilted[p],
                 -1.f, 1.f);
  const float across = safe_sqrt(1.f - sine_i * sine_i);
  const float gained =
      p + 1 == lobes ? 2.f * pi * u.y : exit_azimuth(e, p) + sample_trimmed_logistic(u.y, s_);
  const float phi = e.phi + gained;
  return glm::normalize(vec3(sine_i, across * std::cos(phi), across * std::sin(phi)));
}

std::optional<BsdfSample> HairBsdf::sample(const vec3& wo, float u_lobe, const vec2& u,
                                           Transport mode) const {
  if (wo.z == 0.f) return std::nullopt;
  const Entry e = enter(wo);
  size_t p = 0;
  while (p + 1 < lobes && !(u_lobe < e.probability[p])) u_lobe -= e.probability[p++];
  while (p > 0 && !(e.probability[p] > 0.f)) --p;
  if (!(e.probability[p] > 0.f)) return std::nullopt;
  const float turn = std::clamp(u_lobe / e.probability[p], 0.f, one_minus_epsilon);
  BsdfSample s;
  s.wi = direction(e, p, turn, u);
  s.pdf = density(e, s.wi);
  if (s.wi.z == 0.f || !(s.pdf > 0.f) || !std::isfinite(s.pdf)) return std::nullopt;
  s.weight = mode == Transport::radiance
                 ? scattered(e, s.wi) / s.pdf
                 : scattered(enter(s.wi), wo) * (std::abs(s.wi.z / wo.z) / s.pdf);
  s.pdf_reverse = pdf(s.wi, wo);
  s.transmitted = wo.z * s.wi.z < 0.f;
  return s;
}

Rgb HairBsdf::albedo(const vec3& wo) const {
  Rgb sum(0.f);
  for (const Rgb& a : enter(wo).attenuation) sum += a;
  return sum;
}

}  // namespace pssmlt
