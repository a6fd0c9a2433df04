#include "core/scene/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>

#include "core/base/error.h"
#include "core/base/float_traps.h"
#include "core/base/thread_order.h"

namespace pssmlt {
namespace {

// What Embree hands back for user geometries: their shape.
struct UserGeometry {
  const Shape* shape = nullptr;
};

void user_bounds(const RTCBoundsFunctionArguments* args) {
  happens_after(args->geometryUserPtr);  // Embree builds with threads of its own
  const Bounds b = static_cast<const UserGeometry*>(args->geometryUserPtr)->shape->bounds();
  RTCBounds* const out = args->bounds_o;
  out->lower_x = b.min.x, out->lower_y = b.min.y, out->lower_z = b.min.z;
  out->upper_x = b.max.x, out->upper_y = b.max.y, out->upper_z = b.max.z;
}

void user_intersect(const RTCIntersectFunctionNArguments* args) {
  const FloatTraps traps(traps_floats);
  if (args->valid[0] == 0) return;
  const auto* const geometry = static_cast<const UserGeometry*>(args->geometryUserPtr);
  auto* const rayhit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  RTCRay& r = rayhit->ray;
  const Ray ray{{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tfar};
  const auto found = geometry->shape->intersect(ray, r.tnear);
  if (!found) return;
  r.tfar = found->t;
  RTCHit& h = rayhit->hit;
  h.u = found->uv.x;
  h.v = found->uv.y;
  h.geomID = args->geomID;
  h.primID = found->element;
  h.instID[0] = args->context->instID[0];
}

void user_occluded(const RTCOccludedFunctionNArguments* args) {
  const FloatTraps traps(traps_floats);
  if (args->valid[0] == 0) return;
  const auto* const geometry = static_cast<const UserGeometry*>(args->geometryUserPtr);
  auto* const r = reinterpret_cast<RTCRay*>(args->ray);
  const Ray ray{{r->org_x, r->org_y, r->org_z}, {r->dir_x, r->dir_y, r->dir_z}, r->tfar};
  if (geometry->shape->intersect(ray, r->tnear)) r->tfar = -infinity;
}

// Embree takes no ray whose origin or direction exceeds 1.844e18 or is not a number; it ends the
// process for one (its assertions are on in Debian).
constexpr double embree_reach = static_cast<double>(Accel::max_reach);

bool within(const vec3& v, float reach) {
  return std::abs(v.x) <= reach && std::abs(v.y) <= reach && std::abs(v.z) <= reach;
}

RTCRay to_embree(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  // Not 0: a ray that starts in a plane through the origin, where positions and thus their errors
  // are exactly 0, has not been moved out of it and meets it at once.
  r.tnear = 0x1p-80f;
  r.tfar = ray.t_max;
  r.time = ray.time;
  r.mask = ~0u;
  r.id = 0;
  r.flags = 0;
  return r;
}

// Relative rounding of positions; what moves has Embree's interpolation in float as well.
constexpr double moving_error = 0x1p-19, still_error = 0x1p-22;

// Transforms a hit of an object to render space; error bounds grow by the matrix's rounding.
void transform_hit(const Transform& to_render, double rounding, Hit& hit) {
  const dmat4& m = to_render.matrix();
  const dvec3 p = to_render.point(dvec3(hit.position));
  vec3 error(0.f);
  for (int i = 0; i < 3; ++i) {
    double e = 0.0;
    for (int k = 0; k < 3; ++k) e += std::abs(m[k][i]) * static_cast<double>(hit.error[k]);
    error[i] = static_cast<float>(e + std::abs(p[i]) * rounding);
  }
  hit.position = vec3(p);
  hit.error = error;
  // The inverse transpose keeps normals on their side of the surface, mirrored or not.
  hit.ng = glm::normalize(to_render.normal(hit.ng));
  hit.ns = glm::normalize(to_render.normal(hit.ns));
  if (!hit.with_derivatives) return;
  hit.dpdu = to_render.vector(hit.dpdu);
  hit.dpdv = to_render.vector(hit.dpdv);
  hit.dndu = to_render.normal(hit.dndu);
  hit.dndv = to_render.normal(hit.dndv);
}

}  // namespace

namespace {

// Frobenius norms bound what a matrix does to lengths.
float stretch_of(const Accel::Instance& instance) {
  double most = 0.0;
  for (const float time : {0.f, 1.f}) {
    const Transform to_render = instance.at(time);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const dvec3 column(to_render.matrix()[i]);
      sum += glm::dot(column, column);
    }
    most = std::max(most, sum);
  }
  return static_cast<float>(std::sqrt(most));
}

void set_transform(RTCGeometry geometry, const Accel::Instance& instance) {
  if (!instance.motion) {
    const glm::mat4 m(instance.to_render.matrix());
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &m[0][0]);
    return;
  }
  rtcSetGeometryTimeStepCount(geometry, 2);
  for (unsigned step = 0; step < 2; ++step) {
    const Pose& pose = instance.motion->poses()[step];
    const glm::quat q(pose.rotation);
    const glm::mat3 s(pose.stretch);
    const glm::vec3 t(pose.translation);
    RTCQuaternionDecomposition d;
    rtcInitQuaternionDecomposition(&d);
    rtcQuaternionDecompositionSetQuaternion(&d, q.w, q.x, q.y, q.z);
    rtcQuaternionDecompositionSetScale(&d, s[0][0], s[1][1], s[2][2]);
    rtcQuaternionDecompositionSetSkew(&d, s[1][0], s[2][0], s[2][1]);
    rtcQuaternionDecompositionSetTranslation(&d, t.x, t.y, t.z);
    rtcSetGeometryTransformQuaternion(geometry, step, &d);
  }
}

}  // namespace

struct Accel::Impl {
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> object_scenes;
  std::vector<std::unique_ptr<UserGeometry>> users;
  std::vector<const Primitive*> primitives;            // by geometry ID of the top scene
  std::vector<std::vector<const Primitive*>> objects;  // by geometry ID of an object's scene
  std::vector<Instance> instances;
  std::vector<float> stretches;  // of the instances: upper bounds of what lengths grow by
  uint32_t first_instance_id = 0;
  std::atomic<int64_t> bytes{0};
  std::string failure;

  void attach(RTCScene scene, const Primitive& primitive, uint32_t id);
  void attach_mesh(RTCGeometry geometry, const TriangleMesh& mesh);
  RTCScene make_scene();
  void check();
};

void Accel::Impl::attach_mesh(RTCGeometry geometry, const TriangleMesh& mesh) {
  // The shapes keep their arrays; Embree reads 4 bytes past the last vertex, which std::vector's
  // storage does not promise, so positions are copied into Embree's own padded buffer.
  void* const positions = rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size());
  if (positions)
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(vec3));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(glm::uvec3), mesh.triangles.size());
}

void Accel::Impl::attach(RTCScene scene, const Primitive& primitive, uint32_t id) {
  const TriangleMesh* const mesh = primitive.shape->mesh();
  const RTCGeometry geometry =
      rtcNewGeometry(device, mesh ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_USER);
  if (mesh) {
    attach_mesh(geometry, *mesh);
  } else {
    users.push_back(std::make_unique<UserGeometry>(UserGeometry{primitive.shape.get()}));
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, users.back().get());
    happens_before(users.back().get());
    rtcSetGeometryBoundsFunction(geometry, user_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, user_intersect);
    rtcSetGeometryOccludedFunction(geometry, user_occluded);
  }
  // MEDIUM: the structure, and with it every hit, does not depend on the number of threads.
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

RTCScene Accel::Impl::make_scene() {
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

void Accel::Impl::check() {
  if (!failure.empty()) throw Failure("acceleration structure: " + failure);
}

Accel::Accel() : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  if (!impl_->device) throw Failure("Embree could not be initialised");
  rtcSetDeviceErrorFunction(
      impl_->device,
      [](void* user, RTCError, const char* text) {
        auto& failure = *static_cast<std::string*>(user);
        if (failure.empty()) failure = text;
      },
      &impl_->failure);
  rtcSetDeviceMemoryMonitorFunction(
      impl_->device,
      [](void* user, ssize_t bytes, bool) {
        *static_cast<std::atomic<int64_t>*>(user) += bytes;
        return true;
      },
      &impl_->bytes);
}

Accel::~Accel() {
  for (const RTCScene scene : impl_->object_scenes) rtcReleaseScene(scene);
  if (impl_->top) rtcReleaseScene(impl_->top);
  rtcReleaseDevice(impl_->device);
}

double Accel::reach_of(const Transform& to_render) {
  const Transform from_render = to_render.inverse();
  const dmat4& inverse = from_render.matrix();
  double reach = embree_reach;
  for (int row = 0; row < 3; ++row) {
    double sum = 1.0;
    for (int column = 0; column < 3; ++column) sum += std::abs(inverse[column][row]);
    reach = std::min(reach, (embree_reach - std::abs(inverse[3][row])) / sum);
  }
  return reach;
}

void Accel::build(const std::vector<const Primitive*>& primitives,
                  const std::vector<std::vector<const Primitive*>>& objects,
                  std::vector<Instance> all_instances) {
  const NoFloatTraps embree;
  Impl& d = *impl_;
  d.primitives = primitives;
  d.objects = objects;
  d.instances = std::move(all_instances);
  const std::vector<Instance>& instances = d.instances;
  for (const auto& object : objects) {
    const RTCScene scene = d.make_scene();
    for (uint32_t i = 0; i < object.size(); ++i) d.attach(scene, *object[i], i);
    rtcCommitScene(scene);
    d.object_scenes.push_back(scene);
  }
  d.top = d.make_scene();
  double reach = embree_reach;
  for (const Instance& instance : instances) {
    reach = std::min(reach, std::min(reach_of(instance.at(0.f)), reach_of(instance.at(1.f))));
  }
  reach_ = static_cast<float>(std::max(reach, 0.0));
  for (uint32_t i = 0; i < primitives.size(); ++i) d.attach(d.top, *primitives[i], i);
  d.first_instance_id = static_cast<uint32_t>(primitives.size());
  for (uint32_t i = 0; i < instances.size(); ++i) {
    const RTCGeometry geometry = rtcNewGeometry(d.device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, d.object_scenes[instances[i].object]);
    set_transform(geometry, instances[i]);
    d.stretches.push_back(stretch_of(instances[i]));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(d.top, geometry, d.first_instance_id + i);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(d.top);
  d.check();
}

const std::vector<Accel::Instance>& Accel::instances() const { return impl_->instances; }

bool Accel::intersect(const Ray& ray, RawHit& hit) const {
  if (!within(ray.origin, reach_) || !within(ray.direction, 2.f)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  {
    const NoFloatTraps embree;
    rtcIntersect1(impl_->top, &context, &query);
  }
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.t = query.ray.tfar;
  hit.time = ray.time;
  hit.where = {query.hit.u, query.hit.v};
  hit.element = query.hit.primID;
  if (query.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) {
    hit.instance = -1;
    hit.primitive = impl_->primitives[query.hit.geomID];
  } else {
    hit.instance = static_cast<int>(query.hit.instID[0] - impl_->first_instance_id);
    const uint32_t object = impl_->instances[static_cast<size_t>(hit.instance)].object;
    hit.primitive = impl_->objects[object][query.hit.geomID];
  }
  return true;
}

bool Accel::occluded(const Ray& ray) const {
  if (!within(ray.origin, reach_) || !within(ray.direction, 2.f)) return true;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = to_embree(ray);
  const NoFloatTraps embree;
  rtcOccluded1(impl_->top, &context, &query);
  return query.tfar < 0.f;
}

// Points that are known worse than this part of the ray's length are found anew: angles at the
// other end change by as much.
constexpr float coarse = 0x1p-16f;

void Accel::fill(const Ray& ray, const RawHit& raw, Hit& hit) const {
  hit.distance = raw.t;
  hit.primitive = raw.primitive;
  hit.element = raw.element;
  hit.with_derivatives = raw.primitive->derivatives;
  raw.primitive->shape->fill(raw.where, hit);
  float grain = raw.primitive->grain;
  if (raw.instance >= 0) {
    to_render(raw, hit);
    grain *= impl_->stretches[static_cast<size_t>(raw.instance)];
  }
  if (grain > coarse * raw.t) refine(ray, raw, hit);
}

void Accel::to_render(const RawHit& raw, Hit& hit) const {
  const Instance& instance = impl_->instances[static_cast<size_t>(raw.instance)];
  transform_hit(instance.at(raw.time), instance.motion ? moving_error : still_error, hit);
}

void Accel::refine(const Ray& ray, const RawHit& raw, Hit& hit) const {
  const Shape& shape = *raw.primitive->shape;
  const dvec3 origin(ray.origin), direction(ray.direction);
  if (raw.instance < 0) return shape.refine(origin, direction, hit);
  const Transform from_render =
      impl_->instances[static_cast<size_t>(raw.instance)].at(raw.time).inverse();
  shape.fill(raw.where, hit);
  shape.refine(from_render.point(origin), from_render.vector(direction), hit);
  to_render(raw, hit);
}

SceneBounds Accel::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(impl_->top, &b);
  const vec3 lower(b.lower_x, b.lower_y, b.lower_z), upper(b.upper_x, b.upper_y, b.upper_z);
  if (!(lower.x <= upper.x)) return {vec3(0.f), 0.f};
  return {0.5f * (lower + upper), 0.5f * glm::distance(lower, upper)};
}

uint64_t Accel::bytes() const {
  return static_cast<uint64_t>(std::max<int64_t>(0, impl_->bytes.load()));
}

}  // namespace pssmlt
