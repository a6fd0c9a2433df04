#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/scene/parser.h"

namespace pssmlt {
namespace {

namespace fs = std::filesystem;

// Scenes that other renderers' users share, if they are on this machine.
TEST(ReferenceScenes, AreRead) {
  const char* const given = std::getenv("PSSMLT_REFERENCE_SCENES");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(PSSMLT_SOURCE_DIR) / "../shared/scenes";
  if (!fs::is_directory(folder))
    GTEST_SKIP() << "REFERENCE SCENES NOT TESTED: no folder " << folder
                 << "; name one in PSSMLT_REFERENCE_SCENES";
  int scenes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".pbrt" || entry.path().parent_path().filename() == "geometry")
      continue;
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW({
      const SceneDescription s = parse_file(entry.path().string(), nullptr);
      EXPECT_FALSE(s.shapes.empty());
      EXPECT_TRUE(s.camera.given());
    });
    ++scenes;
  }
  EXPECT_GT(scenes, 0);
}

}  // namespace
}  // namespace pssmlt
