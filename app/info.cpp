// pssmlt info: what a scene contains and what of it costs memory.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>

#include "app/defaults.h"
#include "app/parse_arguments.h"
#include "app/progress.h"
#include "app/read_scene.h"
#include "core/image/texel_store.h"
#include "core/path/path_expression.h"

namespace pssmlt {
namespace {

void print(const std::string& text) { std::puts(text.c_str()); }

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text.empty() ? "nothing" : text;
}

std::string contents(const SceneFeatures& f) {
  std::vector<std::string> parts;
  const std::pair<bool, const char*> features[] = {
      {f.area_lights, "area lights"},
      {f.infinite_lights, "environment light"},
      {f.delta_lights, "point, spot or distant lights"},
      {f.connectible, "non-specular materials"},
      {f.specular, "specular materials"},
      {f.transmissive, "transmission"},
      {f.alpha, "cut-outs"},
      {f.textures, "textures"},
      {f.instances, "instances"},
      {f.delta_lens, "pinhole camera"}};
  for (const auto& [present, name] : features) {
    if (present) parts.emplace_back(name);
  }
  return joined(parts);
}

void print_layer(const Layer& layer) {
  const PathLimits& limits = layer.integrator->limits();
  print(fmt::format("layer{}: integrator {}, sampler {}, default {:.6g} {} a pixel",
                    layer.name.empty() ? "" : " " + layer.name, layer.integrator_name,
                    layer.sampler_name, layer.sampler->default_spp(),
                    layer.sampler->is_chain() ? "mutations" : "samples"));
  print(fmt::format("  paths {} with {} to {} bounces; the integrator sees {}", limits.paths.text(),
                    limits.min_bounces, limits.max_bounces, layer.integrator->sees()));
}

}  // namespace

int run_info(const Arguments& arguments) {
  CLI::App app("Prints what a scene contains.", "pssmlt info");
  std::string path;
  app.add_option("scene", path, "scene file")->required();
  std::string cache;
  app.add_option("--texture-cache", cache, "limit of the textures' memory, e.g. 1GB");
  if (!parse_arguments(app, arguments)) return 0;
  if (!cache.empty()) set_texture_cache(parse_bytes(cache));
  std::vector<std::string> log;
  const SceneDescription description = read_scene(path, &log);
  BuildOptions options;
  options.defaults = command_plugins();
  const BuiltScene scene = build_scene(description, options);
  for (const std::string& line : log) print("note: " + line);
  for (const std::string& line : scene.log) print("note: " + line);
  for (const std::string& line : scene.warnings) print("warning: " + line);
  const SceneFeatures& f = scene.scene->features();
  const RasterFrame& r = scene.scene->frame();
  print(fmt::format("picture: {} x {} pixels, window {},{} to {},{}", r.resolution.x,
                    r.resolution.y, r.crop_min.x, r.crop_min.y, r.crop_max.x, r.crop_max.y));
  print("contains: " + contents(f));
  print(fmt::format("lights: {}", f.lights));
  print(fmt::format("geometry: {} triangles, {} other shapes, {} instances", f.triangles,
                    f.user_shapes, f.instance_count));
  print(fmt::format("acceleration structure: {}B, built in {:.3g} s",
                    format_count(static_cast<double>(f.accel_bytes)), f.accel_seconds));
  const TexelMemory texels = texel_memory();
  print(fmt::format(
      "images of textures: {}B, {}B in memory{}", format_count(static_cast<double>(texels.total)),
      format_count(static_cast<double>(texels.resident)),
      texels.limit == 0
          ? ""
          : fmt::format(" (at most {}B)", format_count(static_cast<double>(texels.limit)))));
  print(fmt::format("loading: {:.3g} s", f.load_seconds));
  for (const Layer& layer : scene.layers) print_layer(layer);
  print("left out: " + joined(f.left_out));
  return 0;
}

}  // namespace pssmlt
