// How fast this machine traces: incoherent single rays through 200,000 random triangles in a unit
// cube with bare Embree, in rays per second of wall time on one thread and on two. Published
// figures of sample rates and errors can be translated by the ratio of this number. With the
// argument "arithmetic": a loop that stays in registers instead, in its turns per second, which
// says what two threads could gain at most while the host's other guests are busy.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <functional>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/random.h"

namespace {

using pssmlt::RandomStream;
using pssmlt::RandomUse;
using pssmlt::vec3;

vec3 random_point(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  const float z = random.next();
  return {x, y, z};
}

RTCScene make_scene(RTCDevice device) {
  constexpr size_t triangles = 200000;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const p = static_cast<vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), 3 * triangles));
  auto* const index = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangles));
  RandomStream random(1, RandomUse::test);
  for (size_t i = 0; i < 3 * triangles; ++i) {
    if (i % 3 == 0) {
      p[i] = random_point(random);
    } else {
      const vec3 offset = random_point(random);
      p[i] = p[i - i % 3] + 0.02f * (offset - 0.5f);
    }
    index[i] = static_cast<uint32_t>(i);
  }
  rtcCommitGeometry(geometry);
  const RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

void trace(RTCScene scene, uint32_t thread, int rays) {
  RandomStream random(2, RandomUse::test, thread);
  for (int i = 0; i < rays; ++i) {
    const vec3 o = random_point(random);
    const vec3 target = random_point(random);
    const vec3 d = glm::normalize(target - o);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit q{};
    q.ray.org_x = o.x, q.ray.org_y = o.y, q.ray.org_z = o.z;
    q.ray.dir_x = d.x, q.ray.dir_y = d.y, q.ray.dir_z = d.z;
    q.ray.tfar = std::numeric_limits<float>::infinity();
    q.ray.mask = ~0u;
    q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &q);
  }
}

// Eight chains of multiplications and additions that depend on nothing in memory.
void compute(uint32_t thread, int turns) {
  std::array<float, 8> x{};
  x.fill(static_cast<float>(thread));
  for (int i = 0; i < turns; ++i) {
    for (float& value : x) value = value * 0.9999f + 0.5f;
  }
  volatile float sink = 0.f;
  for (const float value : x) sink = sink + value;
}

// Work of all threads per second of wall time.
double per_second(int work, uint32_t threads, const std::function<void(uint32_t, int)>& body) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::jthread> workers;
  for (uint32_t t = 0; t < threads; ++t) workers.emplace_back(body, t, work);
  workers.clear();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return work * static_cast<double>(threads) / wall.count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "arithmetic") {
    constexpr int turns = 200000000;
    fmt::print("1 thread   {:.3f} M/s\n", per_second(turns, 1, compute) * 1e-6);
    fmt::print("2 threads  {:.3f} M/s\n", per_second(turns, 2, compute) * 1e-6);
    return 0;
  }
  const RTCDevice device = rtcNewDevice(nullptr);
  const RTCScene scene = make_scene(device);
  constexpr int rays = 2000000;
  const auto body = [scene](uint32_t thread, int work) { trace(scene, thread, work); };
  per_second(rays, 1, body);
  fmt::print("1 thread   {:.3f} Mray/s\n", per_second(rays, 1, body) * 1e-6);
  fmt::print("2 threads  {:.3f} Mray/s\n", per_second(rays, 2, body) * 1e-6);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
