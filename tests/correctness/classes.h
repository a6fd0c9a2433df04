// Which classes of paths integrators see, told by the integrators themselves.
#pragma once

#include <string>
#include <vector>

#include "core/path/path_expression.h"
#include "core/path/visible_classes.h"
#include "core/scene/scene.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {

// Plugins made with their defaults.
template <typename Kind>
std::shared_ptr<Kind> make_default(const std::string& kind, const std::string& name) {
  const FoundPlugin found = Registry::instance().find(kind, name, {});
  const ParameterSet none;
  Parameters parameters(none, {}, kind + " \"" + name + "\"", nullptr);
  return make_plugin<Kind>(found, parameters);
}
inline std::string sees(const std::string& integrator) {
  return make_default<Integrator>("integrator", integrator)->sees();
}
inline bool is_for_chains(const std::string& integrator) {
  return make_default<Integrator>("integrator", integrator)->is_for_chains();
}

inline bool is_chain(const std::string& sampler) {
  return make_default<Sampler>("sampler", sampler)->is_chain();
}

// Paths that match both expressions.
inline std::string both(const std::string& a, const std::string& b) {
  return both_expressions(a, b);
}
inline std::vector<std::string> all_classes(int bounces) { return all_path_classes(bounces); }

// The integrator that sees the most classes.
inline std::string sees_most() {
  std::string best;
  int most = -1;
  for (const std::string& name : integrators()) {
    const PathExpression mask(sees(name));
    int count = 0;
    for (const std::string& path : all_classes(5)) count += mask.matches(path) ? 1 : 0;
    if (count > most) most = count, best = name;
  }
  return best;
}

// True if no light of these classes can reach the picture at all.
inline bool unseen(const BuiltScene& built, const std::string& classes) {
  const PathLimits& limits = built.layers.front().integrator->limits();
  return PathExpression::disjoint(PathExpression(classes), PathExpression(),
                                  built.scene->features(), limits.min_bounces, limits.max_bounces);
}

}  // namespace pssmlt::test
