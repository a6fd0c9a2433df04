// Bidirectional path tracing (Veach 1997, chapter 10; Lafortune and Willems 1993): a subpath from
// the camera and one from a light, all their vertices joined, every strategy (s light vertices,
// t camera vertices; s >= 0, t >= 1) weighted by multiple importance sampling (core/path/
// bidirectional.h). Good for light that both ends find half-way; blind only to
// specular-diffuse-specular paths from lights that can't be hit.

#include "core/integrator.h"
#include "core/path/bidirectional.h"
#include "core/path/subpath_cache.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Vertices past this index are joined with one vertex of the other side, drawn at random, so that
// the work grows linearly with the depth.
constexpr int all_pairs = 32;

struct Scratch {
  SubpathCache camera, light;
};

class Bdpt final : public Integrator {
 public:
  static constexpr const char* summary =
      "bidirectional path tracing, all strategies with multiple importance sampling (Veach 1997)";

  explicit Bdpt(Parameters& p) : strategies_(p) {
    const bool unweighted = p.flag("unweighted", false,
                                   "every strategy counts in full, to look at "
                                   "strategies one by one; the picture is not their sum");
    const int s = p.integer("s", -1, "vertices",
                            "only strategies with this many light vertices; "
                            "-1: all");
    const int t = p.integer("t", -1, "vertices",
                            "only strategies with this many camera vertices; "
                            "-1: all");
    strategies_.show(unweighted, s, t);
    const bool strategies = p.flag("visualizestrategies", false,
                                   "read, not applied: ask the renderer for images by strategy");
    const bool weights = p.flag("visualizeweights", false, "as above");
    if (p.describing()) return;
    if (strategies || weights) {
      p.note(
          "images by strategy are not applied here: --per-strategy writes them (with \"bool "
          "unweighted\" true the unweighted ones)");
    }
    if (s < -1) p.fail("s", "s must be -1 or a number of vertices");
    if (t < -1 || t == 0) p.fail("t", "t must be -1 or a number of vertices from 1 on");
  }

  void prepare(const Scene& scene) override { strategies_.prepare(scene); }
  std::string sees() const override { return strategies_.sees(); }
  bool splats_light() const override { return true; }
  const PathLimits& limits() const override { return strategies_.limits(); }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  void join_all(const Subpath& camera, const Subpath& light, PrimarySample& u, Splats& out) const;

  Bidirectional strategies_;
};

void Bdpt::sample(PrimarySample& u, Splats& out, Workspace& workspace) const {
  Scratch& scratch = workspace.scratch<Scratch>();
  const int room = std::min(limits().max_bounces + 1, 200);
  scratch.camera.reserve(room);
  scratch.light.reserve(room);
  bool fresh = false;
  Subpath& camera = scratch.camera.find(u.version(Stream::camera), fresh);
  u.raster();  // camera splats are credited there, whether or not the subpath is reused
  if (fresh) strategies_.tracer().from_camera(u, camera);
  for (int k = 1; k <= camera.size(); ++k) strategies_.hit_at(camera, k, u, out);
  strategies_.hit_beyond(camera, u, out);
  if (strategies_.sensor()) strategies_.draw_light_for_sensor(camera, u, out);
  for (int k = 1; k <= camera.size(); ++k) strategies_.draw_light(camera, k, u, out);
  if (!strategies_.light_side()) return;
  Subpath& light = scratch.light.find(u.version(Stream::light), fresh);
  if (fresh) strategies_.tracer().from_light(u, light);
  if (!light.started) return;
  strategies_.lens_from_light(light, u, out);
  for (int k = 1; k <= light.size(); ++k) strategies_.lens_from(light, k, u, out);
  join_all(camera, light, u, out);
}

// s, t >= 2. Every pair of vertices up to the bound; past it each vertex of the camera subpath is
// joined with one vertex drawn uniformly, which then counts for all it could have been.
void Bdpt::join_all(const Subpath& camera, const Subpath& light, PrimarySample& u,
                    Splats& out) const {
  for (int k = 1; k <= camera.size(); ++k) {
    if (!camera[k].connectible) continue;
    // Light vertices that may be joined: s + t - 2 = (j + 1) + (k + 1) - 2 bounces.
    const int last = std::min(light.size(), limits().max_bounces - k);
    const int all = k <= all_pairs ? std::min(last, all_pairs) : 0;
    for (int j = 1; j <= all; ++j) strategies_.join(camera, k, light, j, 1.f, u, out);
    const int rest = last - all;
    if (rest <= 0) continue;
    const float pick = light_numbers(u, k).pick;
    const int j = all + 1 + std::min(static_cast<int>(pick * static_cast<float>(rest)), rest - 1);
    strategies_.join(camera, k, light, j, static_cast<float>(rest), u, out);
  }
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "bdpt", pssmlt::Bdpt, {"mlt", "pssmlt"}, {"sppm", ""})
