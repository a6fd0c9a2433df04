#include "core/scene/import.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "core/base/float_traps.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace {

struct Format {
  std::string_view ending, module;
};
constexpr std::array<Format, 2> formats = {{{".gltf", "import_gltf"}, {".glb", "import_gltf"}}};

std::string module_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : formats)
    if (ending == format.ending) return std::string(format.module);
  return "";
}

}  // namespace

bool is_importable(const std::string& path) { return !module_of(path).empty(); }

void import_file(const ImportedFile& file, SceneState& state, SceneDescription& scene,
                 std::vector<std::string>* log) {
  const NoFloatTraps library;
  const auto read = reinterpret_cast<ImportFunction*>(
      Registry::instance().module(module_of(file.path), import_symbol));
  std::vector<std::string> unheard;
  read(file, {state, scene, log ? *log : unheard});
}

SceneDescription import_scene(const std::string& path, std::vector<std::string>* log) {
  SceneDescription scene;
  scene.file = path;
  scene.directory = std::filesystem::path(path).parent_path().string();
  const auto fail = [](const Location& where, const std::string& message) {
    throw Error(where, message);
  };
  SceneState state(scene, fail, log);
  import_file({path, {}, path, true}, state, scene, log);
  state.finish({});
  return scene;
}

}  // namespace pssmlt
