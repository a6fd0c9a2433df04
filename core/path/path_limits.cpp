#include "core/path/path_expression.h"

namespace pssmlt {
namespace {

constexpr int deepest = 1 << 28;  // numbers of a vertex have 32-bit addresses, two blocks each

}  // namespace

PathLimits::PathLimits(Parameters& p) {
  min_bounces =
      p.integer("mindepth", 0, "bounces", "paths with fewer scattering vertices are left out");
  max_bounces = p.integer("maxdepth", 5, "bounces",
                          "paths with more scattering vertices are left out; 0: emission only");
  const std::string text = p.text(
      "paths", "L.*E",
      "path classes to render, a light path expression (Heckbert 1990): A finite light, I "
      "environment, P point, spot, distant or hidden light, V a medium that emits, L any light, D "
      "diffuse, rough or in a medium, S perfectly specular, . either, E camera, with ( ) | * + ? "
      "and &");
  // A surface would scatter differently by the path that reached it, and strategies that meet on it
  // would disagree.
  if (p.flag("regularize", false, "roughen surfaces after a rough bounce; read, not applied"))
    p.note("regularize is not applied: surfaces scatter the same for all paths");
  if (p.describing()) return;
  if (min_bounces < 0) p.fail("mindepth", "mindepth must not be negative");
  if (max_bounces < min_bounces || max_bounces > deepest) {
    p.fail("maxdepth", "maxdepth must be between mindepth and " + std::to_string(deepest));
  }
  try {
    paths = PathExpression(text);
  } catch (const Error& e) {
    p.fail("paths", e.what());
  }
}

}  // namespace pssmlt
