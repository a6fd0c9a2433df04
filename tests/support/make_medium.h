// Makes media for tests.
#pragma once

#include <fmt/format.h>

#include "core/medium.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {

// `text`: directives up to and with one MakeNamedMedium.
inline std::shared_ptr<Medium> make_medium(const std::string& text) {
  const SceneDescription scene = parse_string("WorldBegin\n" + text, "test");
  return make_from<Medium>("medium", scene.media.at(0));
}

// A medium of a kind with something in it: those that are given on grids get random ones of
// 3 x 2 x 4 values in the unit cube; nullopt for kinds that need a file.
inline std::optional<std::string> sample_medium(const std::string& kind) {
  if (has_parameter("medium", kind, "filename")) return std::nullopt;
  std::string text = "MakeNamedMedium \"m\" \"string type\" \"" + kind + "\"";
  if (has_parameter("medium", kind, "resolution")) text += " \"integer resolution\" 12";
  if (!has_parameter("medium", kind, "nx")) return text;
  text += " \"integer nx\" 3 \"integer ny\" 2 \"integer nz\" 4";
  RandomStream random(3, RandomUse::test);
  const auto values = [&random](int count) {
    std::string list = " [";
    for (int i = 0; i < count; ++i) list += fmt::format(" {:.3f}", 2.f * random.next());
    return list + " ]";
  };
  if (has_parameter("medium", kind, "density")) return text + " \"float density\"" + values(24);
  return text + " \"rgb sigma_a\"" + values(72) + " \"rgb sigma_s\"" + values(72) + " \"rgb Le\"" +
         values(72);
}

}  // namespace pssmlt::test
