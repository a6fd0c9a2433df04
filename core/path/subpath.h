// Subpaths from either end of a path, with what bidirectional strategies need at every vertex.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/path/light_draw.h"
#include "core/path/mis.h"
#include "core/path/numbers.h"
#include "core/path/path_expression.h"
#include "core/path/surface.h"
#include "core/sampling/primary_sample.h"

namespace pssmlt {

// A vertex of a subpath, on a surface or in a medium.
struct PathVertex {
  Surface surface;
  Rgb throughput{0.f};  // of the path that arrives here, before it scatters
  MisPartial mis;
  PathExpression::State state = 0;  // of the path up to here, this vertex's own letter excluded
  bool connectible = false;         // has been shaded and can be joined
  // All vertices before it scattered like mirrors (delta events), so that no strategy joins them.
  bool mirrored = true;
  // The path has a wavelength, from this vertex or an earlier one; the throughput does not have its
  // colour.
  bool dispersed = false;
  // State with this vertex taken as joined, i.e. connectible (filled if connectible).
  PathExpression::State joined_state = 0;
};

// A camera subpath's last edge if it left the scene.
struct Escape {
  int bounces = -1;  // scattering vertices before it; -1: it did not leave
  vec3 direction{0.f};
  Rgb throughput{0.f};
  MisPartial mis;
  PathExpression::State state = 0;
};

// Vertex 0 is the endpoint (`start`), scattering vertices are 1 ... size(). Memory is kept between
// uses and grows by whole chunks, so that vertices never move.
class Subpath {
 public:
  Emission start;
  bool started = false;          // false: the endpoint emits nothing for these numbers
  const Light* light = nullptr;  // of light subpaths
  float probability = 1.f;       // of choosing it to emit
  float time = 0.f;              // of all its rays (Ray::time)
  EndpointTraits traits;         // of the endpoint
  Escape escape;

  int size() const { return size_; }
  PathVertex& operator[](int k) { return chunks_[index(k) / chunk][index(k) % chunk]; }
  const PathVertex& operator[](int k) const { return chunks_[index(k) / chunk][index(k) % chunk]; }
  // Where vertex k is, endpoint included.
  const vec3& position(int k) const {
    return k == 0 ? start.from.position : (*this)[k].surface.hit.position;
  }

  // Of what arrives at vertex k (PathVertex::dispersed of the one before).
  bool dispersed_before(int k) const { return k > 1 && (*this)[k - 1].dispersed; }

  // Of light subpaths: radiance that leaves the start toward `direction` instead. evaluate() takes
  // the surface for given, emit() weighted it by its opacity, which is the same in all directions.
  EmissionValue emitted(const vec3& direction) const {
    EmissionValue e = light->evaluate(start.from, direction);
    const float opaque = luminance(light->evaluate(start.from, start.direction).value);
    if (opaque > 0.f) e.value *= luminance(start.value) / opaque;
    return e;
  }

  void clear() {
    size_ = 0;
    started = false;
    light = nullptr;
    escape.bounces = -1;
  }
  PathVertex& push() {
    if (static_cast<size_t>(size_) == chunks_.size() * chunk) grow();
    return (*this)[++size_];
  }
  void pop() { --size_; }
  // Makes room for this many vertices, so that push() allocates nothing up to there.
  void reserve(int vertices) {
    while (chunks_.size() * chunk < static_cast<size_t>(vertices)) grow();
  }

 private:
  static constexpr size_t chunk = 16;
  static size_t index(int k) { return static_cast<size_t>(k - 1); }
  void grow() { chunks_.push_back(std::make_unique<PathVertex[]>(chunk)); }
  std::vector<std::unique_ptr<PathVertex[]>> chunks_;
  int size_ = 0;
};

// Random walks from the camera and from the lights. Roulette enters the throughput only, never the
// densities: weights that ignore it are still a partition of unity.
class SubpathTracer {
 public:
  // pick: how lights are drawn by the strategies that the weights of light subpaths know of.
  SubpathTracer(const Scene& scene, const PathLimits& limits, Mis mis,
                LightPick pick = LightPick::power);
  // Fills `path` from the camera's stream, with no more than `most` scattering vertices; reads the
  // raster pair.
  void from_camera(PrimarySample& u, Subpath& path, int most = all) const;
  // Fills `path` from the light's stream. Needs at least one light.
  void from_light(PrimarySample& u, Subpath& path, int most = all) const;
  static constexpr int all = std::numeric_limits<int>::max();
  // Scattering vertices that from_camera and from_light make at most.
  int camera_vertices() const { return camera_vertices_; }
  int light_vertices() const { return limits_.max_bounces; }

 private:
  struct Side {
    Stream stream;
    Transport mode;
    const Light* light;  // null: the camera
    bool hittable;       // paths from the other side can end on the endpoint
    int max_vertices;
    bool camera() const { return mode == Transport::radiance; }
  };
  // The edge being traced, and how the walk left the vertex before it.
  struct Walk {
    Ray ray;
    const Medium* medium = nullptr;  // where the ray starts
    Rgb transmittance{1.f};          // of the edge
    Rgb throughput{0.f};
    float begin = 0.f;        // largest component of the start's throughput
    float eta_squared = 1.f;  // product of squared index ratios
    float pdf = 0.f, pdf_reverse = 0.f;
    bool delta = false;
    bool mirrored = true;  // PathVertex::mirrored
    PathExpression::State state = 0;
    // Not null: no edge, but a way beneath the surface, which goes by these numbers.
    const DiffusionProfile* beneath = nullptr;
    ScatterNumbers numbers;
  };
  void walk(PrimarySample& u, const Side& side, PathExpression::State state, Subpath& path) const;
  // The ray that leaves the endpoint, in the medium there.
  Walk begin(const Side& side, const Subpath& path) const;
  MisPartial first_mis(const Side& side, const Subpath& path, const PathVertex& v,
                       const Rgb& transmittance) const;
  // cos_end, distance2: of Mis::next.
  MisPartial next_mis(const Walk& w, const PathVertex& from, float cos_end, float distance2) const;
  // Follows the walk's ray to vertex k; false where the subpath ends.
  bool advance(PrimarySample& u, const Side& side, int k, Walk& w, Subpath& path) const;
  // The same beneath the surface; false where nothing leaves it.
  bool emerge(int k, Walk& w, Subpath& path) const;
  Escape escape(const Walk& w, const Subpath& path, int k) const;
  bool scatter(PrimarySample& u, const Side& side, const Surface& surface, int k, Walk& w) const;
  PathExpression::State step(const Side& side, PathExpression::State s, bool delta) const;

  const Scene& scene_;
  const PathLimits& limits_;
  Mis mis_;
  LightPick pick_;
  int camera_vertices_;
};

}  // namespace pssmlt
