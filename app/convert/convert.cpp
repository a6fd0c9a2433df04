// pssmlt convert: a scene, with all that it includes, as one file in today's format.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/compare/text.h"
#include "app/convert/scene_text.h"
#include "app/parse_arguments.h"
#include "app/read_scene.h"
#include "core/base/log.h"

namespace pssmlt {
namespace {

namespace fs = std::filesystem;

void check_output(const std::string& output, const SceneDescription& scene, bool force) {
  std::error_code ignored;
  for (const std::string& read : scene.files_read) {
    if (fs::equivalent(read, output, ignored))
      throw Error("\"" + output + "\" is a file of the scene that is converted: name another");
  }
  if (!force && fs::exists(output, ignored))
    throw Error("\"" + output + "\" is there already; --force replaces it");
}

}  // namespace

int run_convert(const Arguments& arguments) {
  CLI::App app(
      "Writes a scene as one file in today's format: pbrt-v3's names are translated, included\n"
      "files are followed, comments are left out, files are named as seen from the new one.",
      "pssmlt convert");
  std::string input, output;
  bool force = false;
  app.add_option("scene", input, "scene file, in pbrt-v3's or pbrt-v4's format")->required();
  app.add_option("output", output, "the new scene file")->required();
  app.add_flag("--force", force, "replace the output if it exists");
  if (!parse_arguments(app, arguments)) return 0;
  std::vector<std::string> log;
  const SceneDescription scene =
      parse_file(input, &log, {.dialect = &pbrt_v3(), .keep_steps = true});
  for (const std::string& line : log) log_info(line);
  check_output(output, scene, force);
  compare::write_file(output, scene_text(scene, fs::path(output).parent_path()));
  log_info("wrote " + output);
  return 0;
}

}  // namespace pssmlt
