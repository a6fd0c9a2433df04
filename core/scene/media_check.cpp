#include "core/scene/media_check.h"

#include <fmt/format.h>

#include "core/base/frame.h"
#include "core/base/random.h"
#include "core/base/warp.h"
#include "core/medium.h"

namespace pssmlt {
namespace {

constexpr int walks = 1024, longest = 8;
// Rays that slip past an edge meet the far side of a surface; that is rare.
constexpr int rare = 100;

struct Tally {
  int edges = 0, contradictions = 0;
  const Primitive* from = nullptr;  // of the first contradiction; null: the camera
  const Primitive* to = nullptr;
};

// Where a ray stands and which medium what it left says is there.
struct Walk {
  Ray ray;
  const Medium* medium = nullptr;
  const Primitive* from = nullptr;
};

// False where the walk ends.
bool follow(const Scene& scene, Walk& w, RandomStream& random, Tally& tally) {
  Hit hit;
  if (!scene.nearest(w.ray, hit)) return false;
  const Primitive& met = *hit.primitive;
  const MediumInterface* const media = met.media;
  if (media) {
    ++tally.edges;
    if (media->toward(-w.ray.direction, hit.ng) != w.medium) {
      if (tally.contradictions++ == 0) tally.from = w.from, tally.to = &met;
    }
  }
  vec3 next = w.ray.direction;
  if (!met.bounds_medium) {
    const float x = random.next();
    const float y = random.next();
    const vec3 local = cosine_hemisphere({x, y});
    const float choice = random.next();
    const bool through = met.transmits && choice < 0.5f;
    const bool outside = (glm::dot(w.ray.direction, hit.ng) < 0.f) != through;
    next = glm::normalize(Frame(outside ? hit.ng : -hit.ng).to_world(local));
  }
  if (media) w.medium = media->toward(next, hit.ng);
  w.from = &met;
  w.ray = {offset_origin(hit.position, hit.error, hit.ng, next), next, infinity, w.ray.time};
  return true;
}

void walk_from_camera(const Scene& scene, RandomStream& random, Tally& tally) {
  const RasterFrame& frame = scene.frame();
  const float x = random.next();
  const float y = random.next();
  const dvec2 raster = dvec2(frame.crop_min) + dvec2(x, y) * dvec2(frame.crop_size());
  const float lens_x = random.next();
  const float lens_y = random.next();
  const auto start = scene.camera_emit({lens_x, lens_y}, raster, scene.time(0.f));
  if (!start) return;
  Walk w;
  w.ray = {offset_origin(start->from.position, start->error, start->from.normal, start->direction),
           start->direction, infinity, scene.time(0.f)};
  w.medium = scene.camera_medium();
  for (int k = 0; k < longest; ++k)
    if (!follow(scene, w, random, tally)) return;
}

}  // namespace

std::string contradicting_media(const Scene& scene) {
  if (!scene.features().media) return "";
  RandomStream random{0, RandomUse::auxiliary};
  Tally tally;
  for (int i = 0; i < walks; ++i) walk_from_camera(scene, random, tally);
  if (tally.contradictions * rare <= tally.edges) return "";
  return fmt::format(
      "media contradict one another: {} and {} disagree about what lies between them "
      "({} of {} rays met such a pair); techniques then show different pictures",
      tally.from ? tally.from->name : "the camera", tally.to->name, tally.contradictions,
      tally.edges);
}

}  // namespace pssmlt
