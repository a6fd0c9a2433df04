// A camera that moves: everything is asked of the camera at rest, in its own space.
#include "core/scene/scene.h"

namespace pssmlt {
namespace {

// Rounding of a position that has been transformed in double.
vec3 rounding(const vec3& position) { return glm::abs(position) * 0x1p-22f; }

EndpointPoint moved(const Transform& by, const EndpointPoint& at) {
  EndpointPoint out = at;
  out.position = by.point(at.position);
  out.normal = by.vector(at.normal);  // rigid motions only
  return out;
}

}  // namespace

Transform Scene::camera_offset(float time) const {
  return camera_motion_->at(time) * camera_motion_->at(0.f).inverse();
}

std::optional<Emission> Scene::moving_emit(const vec2& u_lens, const dvec2& raster,
                                           float time) const {
  auto e = camera_->emit(u_lens, raster);
  if (!e) return e;
  const Transform offset = camera_offset(time);
  e->from = moved(offset, e->from);
  e->error += rounding(e->from.position);
  e->direction = glm::normalize(offset.vector(e->direction));
  return e;
}

std::optional<Toward> Scene::moving_toward(const vec3& reference, const vec2& u, float time) const {
  const Transform offset = camera_offset(time);
  auto t = camera_->toward(offset.inverse().point(reference), u);
  if (!t) return t;
  t->at = moved(offset, t->at);
  t->error += rounding(t->at.position);
  t->wi = glm::normalize(offset.vector(t->wi));
  return t;
}

float Scene::camera_pdf_toward(const vec3& reference, const EndpointPoint& at, float time) const {
  if (!camera_motion_) return camera_->pdf_toward(reference, at);
  const Transform back = camera_offset(time).inverse();
  return camera_->pdf_toward(back.point(reference), moved(back, at));
}

}  // namespace pssmlt
