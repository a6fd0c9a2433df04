#include "app/stress/blindness.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/path/path_expression.h"
#include "core/path/visible_classes.h"

namespace pssmlt::stress {

std::string blindness(const BuiltScene& built, const std::string& classes, int max_depth,
                      bool all) {
  const Layer& layer = built.layers.front();
  const std::string sees = layer.integrator->sees();
  const SceneFeatures& features = built.scene->features();
  if (all) {
    const auto unseen = unseen_class(sees, classes, features, max_depth);
    if (!unseen) return "";
    return fmt::format("{} sees {}: no {}", layer.integrator_name, sees, *unseen);
  }
  constexpr int enough = 64;  // longer paths are made of the same letters
  if (!PathExpression::disjoint(PathExpression(sees), PathExpression(classes), features, 0,
                                std::min(max_depth, enough))) {
    return "";
  }
  return fmt::format("{} sees {}: none of the light of {}", layer.integrator_name, sees, classes);
}

// What an integrator does is told from what it sees: a medium that emits is found by rays from the
// camera alone, behind a rough surface by directions that it sampled alone.
std::string practical_blindness(const Point& point, const Layer& layer) {
  const PathExpression sees(layer.integrator->sees());
  if (point.aimed && !sees.matches("VE")) {
    return layer.integrator_name +
           " follows no rays from the camera, and the picture is too small "
           "a part of the scene to be hit from the lights";
  }
  if (point.narrow && !sees.matches("VDE")) {
    return layer.integrator_name +
           " does not meet lights along sampled lobes, and these are too "
           "narrow to be found by points drawn on light or lens";
  }
  return "";
}

}  // namespace pssmlt::stress
