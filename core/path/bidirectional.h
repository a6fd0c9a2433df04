// The strategies of bidirectional path tracing (Veach 1997, chapter 10; Lafortune and Willems
// 1993), one by one: s vertices of a subpath from a light joined with t of one from the camera,
// weighted by multiple importance sampling against all others. The weights are recursive (Georgiev
// et al. 2012, Implementing Vertex Connection and Merging), O(1) a strategy.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "core/path/subpath.h"
#include "core/sampling/splats.h"

namespace pssmlt {

// s vertices on the light subpath, t on the camera subpath.
struct Strategy {
  int s = 0, t = 0;
  int bounces() const { return s + t - 2; }
  PathTag tag() const {
    return {static_cast<uint32_t>(bounces()), static_cast<uint8_t>(std::min(s, 255)),
            static_cast<uint8_t>(std::min(t, 255))};
  }
};

// Each of the functions adds what its strategy finds, already weighted, to `out`. They leave out
// paths beyond the limits.
class Bidirectional {
 public:
  // "heuristic", "lightsampler" and the limits' parameters.
  explicit Bidirectional(Parameters& parameters);
  // Every strategy in full, to look at it; only with so many vertices (-1: any).
  void show(bool unweighted, int only_s, int only_t) {
    unweighted_ = unweighted;
    only_s_ = only_s;
    only_t_ = only_t;
  }
  void prepare(const Scene& scene);
  std::string sees() const;
  const PathLimits& limits() const { return limits_; }
  const SubpathTracer& tracer() const { return *tracer_; }
  // Whether light subpaths are made at all, and how s = t = 1 is.
  bool light_side() const { return light_side_; }
  bool sensor() const { return sensor_; }

  // s = 0: the camera subpath's vertex k met a light; or the subpath left the scene.
  void hit_at(const Subpath& camera, int k, PrimarySample& u, Splats& out) const;
  void hit_beyond(const Subpath& camera, PrimarySample& u, Splats& out) const;
  // s = 1, t >= 2: next event estimation at vertex k.
  void draw_light(const Subpath& camera, int k, PrimarySample& u, Splats& out) const;
  // s = t = 1: a light drawn for the point of a camera that is a bare surface, or the light as the
  // lens sees it.
  void draw_light_for_sensor(const Subpath& camera, PrimarySample& u, Splats& out) const;
  void lens_from_light(const Subpath& light, PrimarySample& u, Splats& out) const;
  // t = 1, s >= 2: vertex k of a light subpath as the lens sees it.
  void lens_from(const Subpath& light, int k, PrimarySample& u, Splats& out) const;
  // s, t >= 2: vertex k of the camera's, j of the light's; the result times `factor`.
  void join(const Subpath& camera, int k, const Subpath& light, int j, float factor,
            PrimarySample& u, Splats& out) const;

 private:
  LightPick pick_for(const PathVertex& v) const { return v.mirrored ? near_ : far_; }
  bool wants(Strategy st) const {
    return (only_s_ < 0 || only_s_ == st.s) && (only_t_ < 0 || only_t_ == st.t) &&
           limits_.in_range(st.bounces());
  }
  float weight(double light_side, double camera_side) const {
    return unweighted_ ? 1.f : static_cast<float>(Mis::weight(light_side, camera_side));
  }
  void meet_medium(const Subpath& camera, int k, PrimarySample& u, Splats& out) const;
  void hit(const Subpath& camera, int bounces, const Light& light, const EndpointPoint& at,
           Rgb value, PrimarySample& u, Splats& out) const;
  void draw_light_from(const PathVertex& x, Strategy st, PrimarySample& u, Splats& out) const;
  MisPartial partial_at_lens(const Subpath& light, int k) const;

  PathLimits limits_;
  Mis mis_;
  // How lights are drawn for vertices that the camera sees, if by way of mirrors, and for those
  // behind them. There the hierarchy costs as much and gains less: light subpaths reach them.
  LightPick near_, far_;
  bool unweighted_ = false;
  int only_s_ = -1, only_t_ = -1;
  const Scene* scene_ = nullptr;
  std::unique_ptr<const SubpathTracer> tracer_;
  bool light_side_ = false;
  // How the strategy s = t = 1 is made: a light's point joined with the lens, or a light drawn for
  // the point of a camera that is a bare surface.
  bool lamps_to_lens_ = false, sensor_ = false;
};

}  // namespace pssmlt
