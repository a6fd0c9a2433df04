// Integrators answer "what is f(u)?": one light transport estimate for one point u of primary
// sample space. They know neither who chooses u nor what becomes of the splats.
#pragma once

#include <string>

#include "core/plugin/plugin_name.h"
#include "core/sampling/primary_sample.h"
#include "core/sampling/splats.h"
#include "core/sampling/workspace.h"

namespace pssmlt {

class Scene;
class Archive;

class Integrator : public PluginNamed {
 public:
  virtual ~Integrator() = default;
  // Once, before rendering.
  virtual void prepare(const Scene& scene) = 0;
  // f(u): adds splats to `out` (empty when called). No allocation, no locks; thread safe. Values
  // are non-negative and finite; a sample that breaks this is dropped and counted by the caller.
  virtual void sample(PrimarySample& u, Splats& out, Workspace& workspace) const = 0;
  // The paths whose light this integrator can find at all, as a path expression
  // (core/path/path_expression.h) over its strategies. Tests and layers rely on it.
  virtual std::string sees() const = 0;
  // True if splats land elsewhere than at the sample's own raster position.
  virtual bool splats_light() const = 0;
  // The filter and depth limits of the scene's parameters, as a path expression and bounce range.
  virtual const class PathLimits& limits() const = 0;

  // Estimates of the same light that a sampler may choose from before it takes samples for the
  // picture: sample() is that of the one chosen last, of the first before. Not thread safe.
  virtual int alternatives() const { return 1; }
  virtual void choose(int alternative) { (void)alternative; }
  virtual std::string alternative_name(int alternative) const {
    return (void)alternative, plugin_name();
  }

  // True if a sample is one of many parts of what others estimate with each: worth its noise under
  // Markov chains alone. Who chooses among integrators for independent samples leaves it out.
  virtual bool is_for_chains() const { return false; }

  // Work units to run in parallel before round `round` (photon maps, caches): pass() is a pure
  // function of (round, unit, u), merge_passes() runs serially after all of them.
  virtual int passes(int64_t round) const { return (void)round, 0; }
  virtual void pass(int64_t round, int unit, PrimarySample& u) { (void)round, (void)unit, (void)u; }
  virtual void merge_passes(int64_t round) { (void)round; }
  // False if f changes between rounds; such an f cannot be the target of a Markov chain.
  virtual bool fixed() const { return true; }
  virtual void save(Archive& archive) const { (void)archive; }
  virtual void load(Archive& archive) { (void)archive; }
};

}  // namespace pssmlt
