#include "core/layered/layer_walk.h"

#include <cmath>

#include "core/path/mis.h"

namespace pssmlt {

Rgb LayerBase::eval(const vec3& wo, const vec3& wi) const {
  if (!lambertian) return metal.eval(wo, wi);
  return wo.z > 0.f && wi.z > 0.f ? reflectance * inv_pi : Rgb(0.f);
}

float LayerBase::pdf(const vec3& wo, const vec3& wi) const {
  if (!lambertian) return metal.pdf(wo, wi);
  return wo.z > 0.f && wi.z > 0.f ? wi.z * inv_pi : 0.f;
}

std::optional<LayerBase::Draw> LayerBase::draw(const vec3& wo, const vec2& u) const {
  if (lambertian) {
    const vec3 wi = cosine_hemisphere(u);
    if (!(wi.z > 0.f)) return std::nullopt;
    return Draw{wi, reflectance, wi.z * inv_pi};
  }
  if (is_delta()) return Draw{{-wo.x, -wo.y, wo.z}, metal.fresnel()(wo.z), 0.f};
  const auto d = metal.draw(wo, u);
  if (!d) return std::nullopt;
  return Draw{d->wi, d->weight, d->pdf};
}

std::optional<LayerWalk::Crossing> LayerWalk::cross(const vec3& outside, const vec2& u) const {
  if (smooth_) {
    const auto t = refract(outside, vec3(0.f, 0.f, 1.f), medium_.eta);
    if (!t || !(t->direction.z < 0.f)) return std::nullopt;
    return Crossing{t->direction, 1.f - fresnel_dielectric(outside.z, medium_.eta), 0.f};
  }
  // The largest number refracts wherever that is possible.
  const auto drawn = interface_.draw(outside, one_minus_epsilon, u);
  if (!drawn || drawn->facet.reflects) return std::nullopt;
  const float passed = 1.f - drawn->facet.fresnel;
  const float pdf = interface_.density(outside, drawn->facet) / passed;
  if (!(pdf > 0.f)) return std::nullopt;
  return Crossing{drawn->wi, passed * ggx_.shadowing(outside, drawn->wi), pdf};
}

std::pair<float, float> LayerWalk::refracted(const vec3& outside, const vec3& inside) const {
  if (smooth_) return {0.f, 0.f};
  const auto facet = interface_.facet(outside, inside);
  if (!facet || facet->reflects || !(facet->fresnel < 1.f)) return {0.f, 0.f};
  return {interface_.value(*facet, outside, inside, Transport::importance),
          interface_.density(outside, *facet) / (1.f - facet->fresnel)};
}

bool LayerWalk::fly(Walker& at, float u) const {
  const bool up = at.w.z > 0.f;
  const float rest = up ? medium_.thickness - at.z : at.z;
  if (medium_.scatters()) {
    const float dz = -std::log1p(-u) * std::abs(at.w.z);
    if (dz < rest) {
      at.z += up ? dz : -dz;
      return true;
    }
  } else {
    at.throughput *= left(rest, at.w);
  }
  at.z = up ? medium_.thickness : 0.f;
  return false;
}

// Both ways of joining the walk with the exit: the direction that refracts into b, and the
// direction in which the walk goes on anyway.
bool LayerWalk::scatter(Walker& at, const EventNumbers& n, const vec3& b,
                        const std::optional<Crossing>& exit) const {
  at.throughput *= medium_.albedo;
  const HenyeyGreenstein phase(medium_.g);
  const vec3 wo = -at.w;
  const float rest = medium_.thickness - at.z;
  if (exit) {
    const vec3 up = -exit->inside;
    const float p = phase.pdf(wo, up);
    const float share = exit->pdf > 0.f ? power_weight(exit->pdf, p) : 1.f;
    at.sum += at.throughput * (share * p * left(rest, up) * exit->weight / up.z);
  }
  const auto next = phase.sample(wo, 0.f, n.direction, Transport::radiance);
  if (!next || next->wi.z == 0.f) return false;
  at.w = next->wi;
  if (at.w.z > 0.f) {
    const auto [f, pdf] = refracted(b, -at.w);
    if (f > 0.f) at.sum += at.throughput * (f * left(rest, at.w) * power_weight(next->pdf, pdf));
  }
  return true;
}

bool LayerWalk::reflect_at_base(Walker& at, const EventNumbers& n, const vec3& b,
                                const std::optional<Crossing>& exit) const {
  const vec3 wo = -at.w;
  if (exit && !base_.is_delta()) {
    const vec3 up = -exit->inside;
    const float share = exit->pdf > 0.f ? power_weight(exit->pdf, base_.pdf(wo, up)) : 1.f;
    at.sum +=
        at.throughput * base_.eval(wo, up) * (share * left(medium_.thickness, up) * exit->weight);
  }
  const auto next = base_.draw(wo, n.direction);
  if (!next) return false;
  at.throughput *= next->weight;
  at.w = next->wi;
  const auto [f, pdf] = refracted(b, -at.w);
  if (f > 0.f) {
    const float share = next->pdf > 0.f ? power_weight(next->pdf, pdf) : 1.f;
    at.sum += at.throughput * (f * share * left(medium_.thickness, at.w));
  }
  return true;
}

// What leaves has been counted where it was sent up.
bool LayerWalk::reflect_at_boundary(Walker& at, const EventNumbers& n) const {
  const vec3 wo = -at.w;
  if (smooth_) {
    at.throughput *= fresnel_dielectric(wo.z, medium_.eta);
    at.w = {at.w.x, at.w.y, -at.w.z};
    return true;
  }
  const auto drawn = interface_.draw(wo, 0.f, n.direction);
  if (!drawn || !drawn->facet.reflects) return false;
  at.throughput *= drawn->facet.fresnel * ggx_.shadowing(wo, drawn->wi);
  at.w = drawn->wi;
  return true;
}

Rgb LayerWalk::estimate(const vec3& a, const vec3& b, const WalkNumbers& n) const {
  const auto entry = cross(a, n[0].direction);
  if (!entry) return Rgb(0.f);
  const auto exit = cross(b, n[1].direction);
  Walker at;
  at.w = entry->inside;
  at.z = medium_.thickness;
  at.throughput = Rgb(entry->weight);
  for (int k = 0; k < std::min(medium_.events, WalkNumbers::capacity - 2); ++k) {
    const EventNumbers event = n[k + 2];
    if (!(max_component(at.throughput) > 0.f)) break;
    // Roulette as pbrt's: late, and only where little is left.
    if (const float q = max_component(at.throughput); k > 3 && q < 0.25f) {
      if (event.choice >= q) break;
      at.throughput /= q;
    }
    const bool goes_on = fly(at, event.flight) ? scatter(at, event, b, exit)
                         : at.w.z < 0.f        ? reflect_at_base(at, event, b, exit)
                                               : reflect_at_boundary(at, event);
    if (!goes_on) break;
  }
  // The entry as radiance.
  return at.sum / sqr(medium_.eta);
}

}  // namespace pssmlt
