// Multiplexed bidirectional path tracing (Hachisuka, Kaplanyan and Dachsbacher 2014, Multiplexed
// Metropolis Light Transport): each sample makes one strategy of one length of paths, which numbers
// of the sample choose, instead of all of them; subpaths are no longer than that strategy needs.
// Under chains that is cheaper by far than `bdpt`, and what a chain follows is one path. Noisier
// than `bdpt` by independent samples. Lengths one by one, each with a normalisation of its own, are
// layers of equal "mindepth" and "maxdepth".

#include "core/integrator.h"
#include "core/path/bidirectional.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Lengths that are equally probable; past them an n-th one is with 1 / (n (n + 1)) of one of
// theirs.
constexpr int even_lengths = 16;

struct Scratch {
  Subpath camera, light;
};

class Multiplexed final : public Integrator {
 public:
  static constexpr const char* summary =
      "one strategy of bidirectional path tracing a sample (Hachisuka et al. 2014)";

  explicit Multiplexed(Parameters& p) : strategies_(p) {}

  void prepare(const Scene& scene) override { strategies_.prepare(scene); }
  std::string sees() const override { return strategies_.sees(); }
  bool splats_light() const override { return true; }
  bool is_for_chains() const override { return true; }
  const PathLimits& limits() const override { return strategies_.limits(); }
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;

 private:
  // One over its probability.
  struct Choice {
    Strategy strategy;
    float factor = 1.f;
  };
  int choose_bounces(double x, double& factor) const;
  Choice choose_technique(PrimarySample& u) const;
  void from_camera(Strategy st, const Subpath& camera, PrimarySample& u, Splats& out) const;

  Bidirectional strategies_;
};

// x in [0, 1); multiplies `factor` by one over the probability.
int Multiplexed::choose_bounces(double x, double& factor) const {
  const int first = limits().min_bounces, count = limits().max_bounces - first + 1;
  const int even = std::min(count, even_lengths);
  const double at = x * even;
  const int bin = std::min(static_cast<int>(at), even - 1);
  factor *= even;
  if (bin < even - 1 || count == even) return first + bin;
  // The last bin is that of all longer ones: at least n + 1 past the even ones with 1 / (n + 1).
  const int longest = count - even;
  const double rest = std::max(0x1p-31, 1.0 - (at - bin));
  const int past = static_cast<int>(std::min(1.0 / rest - 1.0, static_cast<double>(longest)));
  factor *= past < longest ? (past + 1.0) * (past + 2.0) : past + 1.0;
  return first + bin + past;
}

Multiplexed::Choice Multiplexed::choose_technique(PrimarySample& u) const {
  const TechniqueNumbers x = technique_numbers(u);
  double factor = 1.0;
  const int bounces = choose_bounces(x.length, factor);
  // s = 0 ... bounces + 1, t = bounces + 2 - s. Without light subpaths only s = 0, 1.
  const int strategies = strategies_.light_side() ? bounces + 2 : 2;
  const int s =
      std::min(static_cast<int>(x.strategy * static_cast<float>(strategies)), strategies - 1);
  return {{s, bounces + 2 - s}, static_cast<float>(factor * strategies)};
}

void Multiplexed::sample(PrimarySample& u, Splats& out, Workspace& workspace) const {
  u.raster();  // camera splats are credited there
  Scratch& scratch = workspace.scratch<Scratch>();
  const Choice choice = choose_technique(u);
  const Strategy st = choice.strategy;
  if (st.t > 1 || (st.s == 1 && strategies_.sensor())) {
    strategies_.tracer().from_camera(u, scratch.camera, st.t - 1);
  }
  const bool lit = strategies_.light_side() && (st.s > 1 || (st.s == 1 && st.t == 1));
  if (lit) strategies_.tracer().from_light(u, scratch.light, st.s - 1);
  const Subpath &camera = scratch.camera, &light = scratch.light;
  if (st.s == 0 || (st.s == 1 && st.t > 1)) {
    from_camera(st, camera, u, out);
  } else if (st.s == 1 && strategies_.sensor()) {
    strategies_.draw_light_for_sensor(camera, u, out);
  } else if (lit && light.started && light.size() >= st.s - 1) {
    if (st.s == 1) strategies_.lens_from_light(light, u, out);
    if (st.s > 1 && st.t == 1) strategies_.lens_from(light, st.s - 1, u, out);
    if (st.s > 1 && st.t > 1 && camera.size() >= st.t - 1) {
      strategies_.join(camera, st.t - 1, light, st.s - 1, 1.f, u, out);
    }
  }
  out.scale(choice.factor);
}

void Multiplexed::from_camera(Strategy st, const Subpath& camera, PrimarySample& u,
                              Splats& out) const {
  const int k = st.t - 1;
  if (st.s == 0 && camera.escape.bounces == st.bounces()) strategies_.hit_beyond(camera, u, out);
  if (camera.size() < k) return;
  if (st.s == 0) return strategies_.hit_at(camera, k, u, out);
  strategies_.draw_light(camera, k, u, out);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Integrator, "multiplexed", pssmlt::Multiplexed)
