#include "core/path/surface.h"

namespace pssmlt {

bool Surface::shade(const Scene& scene, const vec3& wo_world, MaterialNumbers u) {
  wo = wo_world;
  frame_ = scene.shading_frame(hit);
  wo_local_ = frame_.to_local(wo);
  bsdf_ = hit.primitive->material->bsdf(hit, u, storage_);
  return bsdf_ != nullptr && wo_local_.z != 0.f;
}

float Surface::adjoint_cosine(const vec3& wi) const {
  const float wo_ng = std::abs(glm::dot(wo, hit.ng));
  if (!(wo_ng > 0.f)) return 0.f;
  return std::abs(wo_local_.z) * std::abs(glm::dot(wi, hit.ng)) / wo_ng;
}

Rgb Surface::f_cos(const vec3& wi, Transport mode) const {
  const vec3 local = frame_.to_local(wi);
  if (local.z == 0.f) return Rgb(0.f);
  const Rgb f = bsdf_->eval(wo_local_, local, mode);
  return f * (mode == Transport::radiance ? std::abs(local.z) : adjoint_cosine(wi));
}

float Surface::pdf(const vec3& wi) const { return bsdf_->pdf(wo_local_, frame_.to_local(wi)); }

Surface::Scattering Surface::scattering(const vec3& wi, Transport mode) const {
  Scattering s;
  const vec3 local = frame_.to_local(wi);
  if (local.z == 0.f) return s;
  const Rgb f = bsdf_->eval(wo_local_, local, mode);
  if (is_black(f)) return s;
  s.f_cos = f * (mode == Transport::radiance ? std::abs(local.z) : adjoint_cosine(wi));
  s.pdf = bsdf_->pdf(wo_local_, local);
  s.pdf_reverse = bsdf_->pdf(local, wo_local_);
  return s;
}

std::optional<ScatterSample> Surface::sample(float u_lobe, const vec2& u, Transport mode) const {
  const auto s = bsdf_->sample(wo_local_, u_lobe, u, mode);
  if (!s || s->wi.z == 0.f) return std::nullopt;
  ScatterSample out{frame_.to_world(s->wi), s->weight, s->pdf, s->pdf_reverse, s->delta,
                    s->transmitted,         s->eta};
  if (mode == Transport::importance) {
    out.weight *= adjoint_cosine(out.wi) / std::abs(s->wi.z);
  }
  return out;
}

}  // namespace pssmlt
