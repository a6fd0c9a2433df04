#include "core/path/visible_classes.h"

#include <algorithm>

#include "core/path/path_expression.h"

namespace pssmlt {
namespace {

constexpr int longest = 5;

}  // namespace

std::vector<std::string> all_path_classes(int bounces) {
  std::vector<std::string> out, level = {"A", "I", "P", "V"};
  for (int k = 0; k <= bounces; ++k) {
    std::vector<std::string> next;
    for (const std::string& path : level) {
      out.push_back(path + "E");
      next.push_back(path + "D");
      next.push_back(path + "S");
    }
    level = std::move(next);
  }
  return out;
}

std::optional<std::string> unseen_class(const std::string& sees, const std::string& classes,
                                        const SceneFeatures& features, int max_depth) {
  const PathExpression wanted(classes), found(both_expressions(sees, classes));
  for (const std::string& path : all_path_classes(std::min(max_depth, longest))) {
    const PathExpression one(path);
    const auto apart = [&](const PathExpression& other) {
      return PathExpression::disjoint(one, other, features, 0, max_depth);
    };
    if (!apart(wanted) && apart(found)) return path;
  }
  return std::nullopt;
}

}  // namespace pssmlt
