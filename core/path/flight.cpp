#include "core/path/flight.h"

namespace pssmlt {
namespace {

// The pieces of a ray between the surfaces that it passes.
class Pieces {
 public:
  Pieces(const Ray& ray, const Medium* medium) : piece_(ray), end_(ray.t_max), medium_(medium) {}

  const Ray& ray() const { return piece_; }
  const Medium* medium() const { return medium_; }
  float travelled() const { return travelled_; }
  // Limits the piece to what was met at the end of it.
  void stop_at(const Hit& hit) { piece_.t_max = hit.distance; }
  void stop_at(float distance) { piece_.t_max = distance; }
  // Goes on behind a surface that lets the ray pass; false where the ray ends.
  bool go_on(const Hit& hit) {
    if (Scene::bounds_medium(hit)) {
      medium_ = hit.primitive->media->toward(piece_.direction, hit.ng);
    }
    travelled_ += hit.distance;
    piece_.origin = offset_origin(hit.position, hit.error, hit.ng, piece_.direction);
    piece_.t_max = end_ - travelled_;
    return piece_.t_max > 0.f;
  }

 private:
  Ray piece_;
  float end_;
  const Medium* medium_;
  float travelled_ = 0.f;
};

// The channel whose optical depth an edge inverts, and how deep it goes there.
struct Target {
  int channel = 0;
  float depth = 0.f;  // [1]
};
Target target(float u) {
  const float scaled = 3.f * u;
  const int channel = std::min(static_cast<int>(scaled), 2);
  const float rest = std::min(scaled - static_cast<float>(channel), one_minus_epsilon);
  return {channel, -std::log1p(-rest)};
}

Arrival arrive(Arrival where, const Rgb& depth, Flight& flight) {
  flight.transmittance = transmittance_of(depth);
  flight.density = mean(flight.transmittance);
  return flight.density > 0.f ? where : Arrival::absorbed;
}

Arrival scatter_at(const Pieces& pieces, const Rgb& depth, Surface& at, Flight& flight) {
  const Ray& ray = pieces.ray();
  at.place(*pieces.medium(), ray.origin + ray.t_max * ray.direction,
           pieces.travelled() + ray.t_max);
  flight.transmittance = transmittance_of(depth);
  flight.density = mean(at.point().extinction * flight.transmittance);
  return flight.density > 0.f ? Arrival::medium : Arrival::absorbed;
}

}  // namespace

Arrival fly_through_media(const Scene& scene, const Ray& ray, const Medium* medium,
                          const EdgeNumbers& u, Surface& at, Flight& flight) {
  Target rest = target(u.distance);
  Rgb depth(0.f);
  float u_alpha = u.alpha;
  Pieces pieces(ray, medium);
  for (;;) {
    const bool found = scene.intersect_any(pieces.ray(), u_alpha, at.hit);
    if (found) pieces.stop_at(at.hit);
    if (const Medium* const here = pieces.medium()) {
      const auto t = here->distance(pieces.ray(), rest.channel, rest.depth);
      if (t) pieces.stop_at(*t);
      const Rgb passed = here->optical_depth(pieces.ray());
      depth += passed;
      if (t) return scatter_at(pieces, depth, at, flight);
      rest.depth = std::fmax(rest.depth - passed[rest.channel], 0.f);
    }
    if (!found || !Scene::bounds_medium(at.hit)) {
      at.hit.distance += pieces.travelled();
      at.leave_medium(pieces.medium());
      return arrive(found ? Arrival::surface : Arrival::nothing, depth, flight);
    }
    if (!pieces.go_on(at.hit)) return Arrival::absorbed;
  }
}

Passage pass_media(const Scene& scene, const Ray& ray, const Medium* medium) {
  Passage passage;
  Rgb depth(0.f);
  Hit hit;
  Pieces pieces(ray, medium);
  for (;;) {
    const bool found = scene.nearest(pieces.ray(), hit);
    if (found) pieces.stop_at(hit);
    if (pieces.medium()) depth += pieces.medium()->optical_depth(pieces.ray());
    if (found && !Scene::bounds_medium(hit)) {
      passage.visibility *= 1.f - Scene::opacity(hit);
      if (!(passage.visibility > 0.f)) return {0.f, Rgb(0.f)};
    }
    if (!found || !pieces.go_on(hit)) break;
  }
  passage.transmittance = transmittance_of(depth);
  return passage;
}

}  // namespace pssmlt
