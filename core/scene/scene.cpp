#include "core/scene/scene.h"

#include <fmt/format.h>

#include "core/path/witness.h"
#include "core/scene/accel.h"
#include "core/scene/path_log.h"

namespace pssmlt {
namespace {

thread_local RayCounters thread_counters;
thread_local std::function<void(const std::string&)> path_listener;
thread_local bool path_logged = false;  // either listener is set
thread_local std::vector<RecordedRay>* recorded_rays = nullptr;

std::string text(const vec3& v) { return fmt::format("({:.6g} {:.6g} {:.6g})", v.x, v.y, v.z); }

void log_ray(const char* what, const Ray& ray, const std::string& outcome) {
  if (recorded_rays) recorded_rays->push_back({ray, what[0] == 's'});
  if (!path_listener) return;
  path_listener(
      fmt::format("{} from {} along {}: {}", what, text(ray.origin), text(ray.direction), outcome));
}

}  // namespace

RayCounters& ray_counters() { return thread_counters; }

void set_path_log(std::function<void(const std::string&)> listener) {
  path_listener = std::move(listener);
  path_logged = path_listener || recorded_rays;
}

void record_rays(std::vector<RecordedRay>* rays) {
  recorded_rays = rays;
  path_logged = path_listener || recorded_rays;
}

Scene::Scene() = default;
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

float Scene::footprint(const vec3& position) const {
  return parallel_ ? pixel_spread_ : pixel_spread_ * glm::distance(camera_center_, position);
}

void Scene::complete(const Ray& ray, const RawHit& raw, Hit& hit) const {
  accel_->fill(ray, raw, hit);
  hit.footprint = footprint(hit.position);
}

float Scene::opacity(const Hit& hit) {
  const Texture<float>* const alpha = hit.primitive->alpha.get();
  return alpha ? std::fmin(std::fmax(alpha->evaluate(hit), 0.f), 1.f) : 1.f;
}

bool Scene::intersect(const Ray& ray, float u_alpha, Hit& hit) const {
  if (!features_.media) return intersect_any(ray, u_alpha, hit);
  Ray rest = ray;
  float travelled = 0.f;
  while (intersect_any(rest, u_alpha, hit)) {
    hit.distance += travelled;
    if (!bounds_medium(hit)) return true;
    travelled = hit.distance;
    rest.origin = offset_origin(hit.position, hit.error, hit.ng, ray.direction);
    rest.t_max = ray.t_max - travelled;
    if (!(rest.t_max > 0.f)) break;
  }
  return false;
}

bool Scene::nearest(const Ray& ray, Hit& hit) const {
  ++thread_counters.shadow;
  RawHit raw;
  const bool found = accel_->intersect(ray, raw);
  if (found) complete(ray, raw, hit);
  if (path_logged) log_ray("shadow ray", ray, found ? "meets " + hit.primitive->name : "free");
  return found;
}

const Medium* Scene::light_medium(const Light& light, const EndpointPoint& at,
                                  const vec3& direction) const {
  const auto found = light_media_.find(&light);
  return found == light_media_.end() ? nullptr : found->second.toward(direction, at.normal);
}

bool Scene::intersect_any(const Ray& ray, float& u_alpha, Hit& hit) const {
  ++thread_counters.nearest;
  bool found = false;
  if (features_.alpha) {
    found = intersect_cut_outs(ray, u_alpha, hit);
  } else {
    RawHit raw;
    found = accel_->intersect(ray, raw);
    if (found) complete(ray, raw, hit);
  }
  if (path_logged) {
    log_ray(
        "ray", ray,
        found ? "meets " + hit.primitive->name + " at " + text(hit.position) : "leaves the scene");
  }
  return found;
}

bool Scene::intersect_cut_outs(const Ray& ray, float& u_alpha, Hit& hit) const {
  RawHit raw;
  Ray rest = ray;
  float travelled = 0.f;
  while (accel_->intersect(rest, raw)) {
    complete(rest, raw, hit);
    const float alpha = opacity(hit);
    hit.distance += travelled;
    if (alpha >= 1.f || u_alpha < alpha) return true;
    // Inversion over the sorted hits: what is left of the number decides at the next one.
    u_alpha = std::min((u_alpha - alpha) / (1.f - alpha), one_minus_epsilon);
    travelled = hit.distance;
    rest.origin = offset_origin(hit.position, hit.error, hit.ng, ray.direction);
    rest.t_max = ray.t_max - travelled;
    if (!(rest.t_max > 0.f)) break;
  }
  return false;
}

float Scene::visibility(const Ray& ray) const {
  ++thread_counters.shadow;
  if (!features_.alpha && !features_.media) {
    const bool blocked = accel_->occluded(ray);
    if (path_logged) log_ray("shadow ray", ray, blocked ? "blocked" : "free");
    return blocked ? 0.f : 1.f;
  }
  const float passed = visibility_of_cut_outs(ray);
  if (path_logged) log_ray("shadow ray", ray, fmt::format("passes {:.6g}", passed));
  return passed;
}

float Scene::visibility_of_cut_outs(const Ray& ray) const {
  float passed = 1.f;
  RawHit raw;
  Hit hit;
  Ray rest = ray;
  while (accel_->intersect(rest, raw)) {
    hit.primitive = raw.primitive;
    const bool seen = !bounds_medium(hit);
    if (seen && !raw.primitive->alpha) return 0.f;
    complete(rest, raw, hit);
    if (seen) passed *= 1.f - opacity(hit);
    if (!(passed > 0.f)) return 0.f;
    rest.origin = offset_origin(hit.position, hit.error, hit.ng, ray.direction);
    rest.t_max -= hit.distance;
    if (!(rest.t_max > 0.f)) break;
  }
  return passed;
}

Ray Scene::segment(const vec3& from, const vec3& from_error, const vec3& from_normal,
                   const vec3& to, const vec3& to_error, const vec3& to_normal, float time) {
  const vec3 straight = to - from;
  const vec3 a = offset_origin(from, from_error, from_normal, straight);
  const vec3 b = offset_origin(to, to_error, to_normal, -straight);
  const vec3 d = b - a;
  const float length = glm::length(d);
  // The far end is already in front of its surface; the factor only covers the rounding of t.
  return {a, length > 0.f ? d / length : vec3(0.f, 0.f, 1.f), length * (1.f - 0x1p-20f), time};
}

Rgb Scene::emitted(const Hit& hit, const vec3& direction) const {
  const Light* const light = hit.primitive->light;
  if (!light) return Rgb(0.f);
  const Rgb value = light->evaluate({hit.position, hit.ng, hit.uv, hit.element}, direction).value;
  if (Witness* const w = Witness::here()) [[unlikely]]
    w->look_at(value, *light);
  return value;
}

Rgb Scene::background(const vec3& direction) const {
  Rgb sum(0.f);
  for (const Light* light : light_table_.infinite()) {
    const Rgb value = light->background(direction);
    if (Witness* const w = Witness::here()) [[unlikely]]
      w->look_at(value, *light);
    sum += value;
  }
  return sum;
}

Frame Scene::shading_frame(const Hit& hit) const {
  const ShadingNormals* const normals = hit.primitive->material->shading_normals();
  if (normals) return normals->frame(hit);
  return hit.with_derivatives ? Frame::from_tangent(hit.ns, hit.dpdu) : Frame(hit.ns);
}

}  // namespace pssmlt
