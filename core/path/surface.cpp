#include "core/path/surface.h"

#include "core/diffusion/boundary_bsdf.h"
#include "core/path/witness.h"

namespace pssmlt {

bool Surface::shade(const Scene& scene, const vec3& wo_world, MaterialNumbers u) {
  wo = wo_world;
  if (in_medium_) {
    frame_ = Frame();
    wo_local_ = wo;
    bsdf_ = medium->phase(hit.position, storage_);
    if (Witness* const w = Witness::here()) [[unlikely]]
      bsdf_ = w->watch(*bsdf_, *medium);
    return !is_black(point_.scattering);
  }
  frame_ = scene.shading_frame(hit);
  wo_local_ = frame_.to_local(wo);
  const Material& material = *hit.primitive->material;
  bsdf_ = material.bsdf(hit, u, storage_);
  if (Witness* const w = Witness::here(); w && bsdf_) [[unlikely]]
    bsdf_ = w->watch(*bsdf_, material);
  return bsdf_ != nullptr && wo_local_.z != 0.f;
}

void Surface::emerge(const Scene& scene, const Hit& at, const DiffusionProfile& profile,
                     float side) {
  hit = at;
  in_medium_ = false;
  emerging_ = true;
  frame_ = scene.shading_frame(hit);
  wo_local_ = {0.f, 0.f, side};
  wo = side * frame_.n;
  bsdf_ = make_exit_bsdf(profile, side, storage_);
}

float Surface::entering_correction() const {
  const float wo_ng = std::abs(glm::dot(wo, hit.ng));
  return wo_ng > 0.f ? std::abs(wo_local_.z) / wo_ng : 0.f;
}

inline float Surface::cosine_factor(const vec3& wi, const vec3& local, Transport mode) const {
  return mode == Transport::radiance ? std::abs(local.z) : importance_cosine(wi);
}

float Surface::importance_cosine(const vec3& wi) const {
  // The other half of the correction was made where the path went beneath.
  const float cosine = std::abs(glm::dot(wi, hit.ng));
  return emerging_ ? cosine : entering_correction() * cosine;
}

Rgb Surface::f_cos(const vec3& wi, Transport mode) const {
  const vec3 local = frame_.to_local(wi);
  if (in_medium_) [[unlikely]]
    return bsdf_->eval(wo_local_, local, mode) * point_.scattering;
  if (local.z == 0.f) return Rgb(0.f);
  return bsdf_->eval(wo_local_, local, mode) * cosine_factor(wi, local, mode);
}

float Surface::pdf(const vec3& wi) const { return bsdf_->pdf(wo_local_, frame_.to_local(wi)); }

Surface::Scattering Surface::scattering(const vec3& wi, Transport mode) const {
  Scattering s;
  const vec3 local = frame_.to_local(wi);
  if (local.z == 0.f && !in_medium_) return s;
  const Bsdf::BothWays v = bsdf_->both_ways(wo_local_, local, mode);
  if (is_black(v.f)) return s;
  s.f_cos = in_medium_ ? v.f * point_.scattering : v.f * cosine_factor(wi, local, mode);
  s.pdf = v.pdf;
  s.pdf_reverse = emerging_ ? bsdf_->pdf(local, beneath) : v.pdf_reverse;
  return s;
}

std::optional<ScatterSample> Surface::sample(float u_lobe, const vec2& u, Transport mode) const {
  const auto s = bsdf_->sample(wo_local_, u_lobe, u, mode);
  if (!s || (s->wi.z == 0.f && !in_medium_)) return std::nullopt;
  ScatterSample out{frame_.to_world(s->wi), s->weight, s->pdf,    s->pdf_reverse, s->delta,
                    s->transmitted,         s->eta,    s->beneath};
  if (in_medium_) {
    out.weight *= point_.scattering;
  } else if (mode == Transport::importance) {
    out.weight *=
        s->beneath ? entering_correction() : cosine_factor(out.wi, s->wi, mode) / std::abs(s->wi.z);
  }
  return out;
}

}  // namespace pssmlt
