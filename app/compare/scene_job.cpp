#include "app/compare/scene_job.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>

#include "app/compare/text.h"
#include "app/parse_numbers.h"
#include "app/read_scene.h"
#include "core/base/log.h"
#include "core/base/random.h"
#include "core/render/checkpoint.h"
#include "core/scene/suggest.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;

void apply_suite_option(const std::string& folder, const std::string& option, SceneRequest& r) {
  const size_t equals = option.find('=');
  const std::string key = option.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : option.substr(equals + 1);
  if (value.empty()) throw Error("\"" + option + "\" must look like size=480x270");
  if (key == "size") {
    r.build.size = parse_size(value);
  } else if (key == "scale") {
    r.build.scale = parse_numbers<float>(value, ',', 1, "a factor like 0.5")[0];
    if (!(r.build.scale > 0.f)) throw Error("\"" + option + "\": must be greater than 0");
  } else if (key == "crop") {
    r.build.crop = parse_crop(value);
  } else if (key == "name") {
    r.name = value;
  } else if (key == "set") {
    r.build.set.push_back(value);
  } else if (key == "reference") {
    r.reference = (fs::path(folder) / value).string();
  } else {
    const std::vector<std::string> known = {"size", "scale", "crop", "name", "set", "reference"};
    throw Error("there is no option \"" + key + "\"" + suggestion(key, known) +
                "; there are: " + join(known, ", "));
  }
}

// Mixes in the files that parameters name (textures, meshes), by their contents.
void hash_files(const ParameterSet& parameters, const fs::path& folder, uint64_t& hash) {
  for (const Parameter& p : parameters) {
    for (const std::string& text : p.strings) {
      std::error_code failed;
      const fs::path file = folder / text;
      if (text.empty() || !fs::is_regular_file(file, failed)) continue;
      const std::string bytes = read_file(file.string());
      hash = hash_bytes(bytes.data(), bytes.size(), hash);
    }
  }
}

uint64_t hash_content(const SceneDescription& s) {
  uint64_t hash = s.hash[0] ^ mix_bits(s.hash[1]);
  const auto all = [&](const auto& directives) {
    for (const auto& d : directives) hash_files(d.parameters, s.directory, hash);
  };
  all(s.textures);
  all(s.materials);
  all(s.lights);
  all(s.area_lights);
  all(s.shapes);
  for (const ObjectDescription& object : s.objects) all(object.shapes);
  return hash;
}

}  // namespace

ivec2 parse_size(const std::string& text) {
  const auto v = parse_numbers<int>(text, 'x', 2, "a size like 640x480");
  return {v[0], v[1]};
}

std::array<int, 4> parse_crop(const std::string& text) {
  const auto v = parse_numbers<int>(text, ',', 4, "a window like 10,200,0,100");
  return {v[0], v[1], v[2], v[3]};
}

SceneRequest request_for(const std::string& file, const BuildOptions& base) {
  fs::path stem = fs::path(file).filename();
  while (stem.has_extension()) stem = stem.stem();  // .txt.gz
  return {.file = file, .name = plain_name(stem.string()), .build = base, .reference = ""};
}

std::vector<SceneRequest> read_suite(const std::string& file, const BuildOptions& base) {
  std::vector<SceneRequest> scenes;
  const std::string folder = fs::path(file).parent_path().string();
  for (const auto& [number, line] : read_lines(file)) {
    try {
      std::istringstream words(line);
      std::string scene, option;
      words >> scene;
      SceneRequest request = request_for((fs::path(folder) / scene).string(), base);
      while (words >> option) apply_suite_option(folder, option, request);
      scenes.push_back(std::move(request));
    } catch (const Error& error) {
      throw Error(file + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (scenes.empty()) throw Error(file + ": there is no scene in it");
  return scenes;
}

void make_names_differ(std::vector<SceneRequest>& scenes) {
  std::map<std::string, int> count;
  for (SceneRequest& s : scenes) {
    const int n = ++count[s.name];
    if (n > 1) s.name += "-" + std::to_string(n);
  }
}

BuiltScene LoadedScene::with(const Technique& technique, const BuildOptions& base) const {
  try {
    return with_layers(built, description, options_for(technique, base));
  } catch (const Error& error) {
    throw Error("technique \"" + technique.name + "\": " + error.what());
  }
}

LoadedScene load_scene(const SceneRequest& request, const Technique& first) {
  const auto start = std::chrono::steady_clock::now();
  LoadedScene loaded;
  std::vector<std::string> log;
  loaded.description = read_scene(request.file, &log);
  loaded.built = build_scene(loaded.description, options_for(first, request.build));
  loaded.load_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  loaded.content_hash = hash_content(loaded.description);
  for (const std::string& line : log) log_debug(line);
  for (const std::string& line : loaded.built.log) log_debug(line);
  for (const std::string& line : loaded.built.warnings) log_warning(request.name + ": " + line);
  return loaded;
}

}  // namespace pssmlt::compare
