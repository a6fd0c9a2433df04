#include "app/render_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "app/defaults.h"
#include "app/parse_arguments.h"
#include "app/parse_numbers.h"
#include "core/image/texel_store.h"

namespace pssmlt {
namespace {

// What the command line gives as text, before it is understood.
struct RawOptions {
  std::string integrator, sampler, time, size, crop, pixel, checkpoint_every, aux, texture_cache;
  double spp = 0.0, target_error = 0.0;
  uint64_t seed = 0;
};

void add_scene_options(CLI::App& app, RenderOptions& o, RawOptions& raw) {
  app.add_option("scene", o.scene, "scene file (.txt, .pbrt, gzip-ed or not; .gltf, .glb)")
      ->required();
  app.add_option("--integrator", raw.integrator, "integrator instead of the scene's");
  app.add_option("--sampler", raw.sampler, "sampler instead of the scene's");
  app.add_option("--set", o.build.set, "change a parameter, e.g. integrator.maxdepth=8")
      ->allow_extra_args(false);
  app.add_option("--size", raw.size, "size of the full picture, WIDTHxHEIGHT [pixels]");
  app.add_option("--scale", o.build.scale, "factor on the picture's size")
      ->check(CLI::PositiveNumber);
  app.add_option("--crop", raw.crop, "window x0,x1,y0,y1 [pixels], upper ends exclusive");
  app.add_flag("--honour-clamp", o.build.honour_clamp,
               "apply the film's maxcomponentvalue to every sample");
  app.add_option("--seed", raw.seed, "seed of all random numbers (the scene's, else 0)")
      ->check(CLI::NonNegativeNumber);
}

void add_budget_options(CLI::App& app, RenderOptions& o, RawOptions& raw) {
  app.add_option("--spp", raw.spp, "samples or mutations per pixel")->check(CLI::PositiveNumber);
  app.add_option("--time", raw.time, "wall time: 500ms, 60s, 5m or 2h; a bare number is seconds");
  app.add_option("--target-error", raw.target_error, "stop at this relative mean square error")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", o.render.threads, "threads (all processors)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--texture-cache", raw.texture_cache,
                 "limit of the textures' memory, e.g. 1GB; the rest lies in a temporary file");
  app.add_option("--checkpoint", o.render.checkpoint, "file to keep the render's state in");
  app.add_option("--checkpoint-every", raw.checkpoint_every, "time between checkpoints (60s)");
  app.add_flag("--resume", o.render.resume,
               "continue from the checkpoint (default: the output's name + .checkpoint)");
}

void add_output_options(CLI::App& app, RenderOptions& o, RawOptions& raw) {
  app.add_option("-o,--output", o.outputs, "output (exr, pfm, hdr, png, jpg); may be repeated")
      ->allow_extra_args(false);
  app.add_option("--aux", raw.aux, "layers in the EXR: albedo,normal,depth,error,halves,variance");
  app.add_flag("--per-length", o.render.per_length, "also one image per number of bounces");
  app.add_flag("--per-strategy", o.render.per_strategy,
               "also one image per bidirectional strategy (s, t)");
  app.add_option("--view", o.view, "OpenColorIO view for 8-bit images");
  app.add_option("--json", o.json, "file for the statistics");
  const auto quiet = app.add_flag("--quiet", o.quiet, "print warnings and errors only");
  app.add_flag("--verbose", o.verbose, "print details")->excludes(quiet);
  app.add_option("--pixel", raw.pixel, "print the paths of pixel x,y instead of rendering");
  app.add_option("--replay", o.replay, "print the sample with this key instead of rendering");
}

void add_view_options(CLI::App& app, RenderOptions& o) {
  ViewOptions& v = o.view_while;
  const auto live = add_live_options(app, v.page, "the render");
  const auto display =
      app.add_option("--display", v.display, "show the picture in the viewer tev at host:port");
  for (const char* instead : {"--pixel", "--replay"}) {
    live->excludes(app.get_option(instead));
    display->excludes(app.get_option(instead));
  }
}

std::vector<std::string> parse_auxiliary(const std::string& text) {
  static const std::vector<std::string> known = {"albedo", "normal", "depth",
                                                 "error",  "halves", "variance"};
  std::vector<std::string> names;
  for (const std::string& name : CLI::detail::split(text, ',')) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error("--aux: there is no \"" + name +
                  "\"; there are albedo, normal, depth, error, halves, variance");
    }
    names.push_back(name);
  }
  return names;
}

void understand_scene_options(RenderOptions& o, const RawOptions& raw) {
  o.build.defaults = command_plugins();
  if (!raw.integrator.empty()) o.build.integrator = raw.integrator;
  if (!raw.sampler.empty()) o.build.sampler = raw.sampler;
  if (!raw.size.empty()) {
    const auto v = parse_numbers<int>(raw.size, 'x', 2, "a size like 640x480");
    o.build.size = ivec2(v[0], v[1]);
  }
  if (!raw.crop.empty()) {
    const auto v = parse_numbers<int>(raw.crop, ',', 4, "a window like 10,200,0,100");
    o.build.crop = {v[0], v[1], v[2], v[3]};
  }
  if (!raw.pixel.empty()) {
    const auto v = parse_numbers<int>(raw.pixel, ',', 2, "a pixel like 100,50");
    o.pixel = ivec2(v[0], v[1]);
  }
}

void understand_budget_options(const CLI::App& app, RenderOptions& o, const RawOptions& raw) {
  if (app.count("--spp") != 0) o.render.spp = raw.spp;
  if (app.count("--target-error") != 0) o.render.target_error = raw.target_error;
  if (app.count("--seed") != 0) o.seed = raw.seed;
  if (!raw.texture_cache.empty()) o.texture_cache = parse_bytes(raw.texture_cache);
  if (!raw.time.empty()) o.render.seconds = parse_duration(raw.time, o.notes);
  if (!raw.checkpoint_every.empty()) {
    o.render.checkpoint_seconds = parse_duration(raw.checkpoint_every, o.notes);
  }
}

}  // namespace

double parse_duration(const std::string& text, std::vector<std::string>& notes) {
  static constexpr std::pair<std::string_view, double> units[] = {
      {"s", 1.0}, {"m", 60.0}, {"h", 3600.0}, {"ms", 1e-3}, {"", 1.0}};
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
  if (error == std::errc() && value > 0.0 && value < 1e9) {
    for (const auto& [name, seconds] : units) {
      if (unit != name) continue;
      if (name.empty()) notes.push_back("\"" + text + "\" is taken as seconds (wall time)");
      return value * seconds;
    }
  }
  throw Error("\"" + text + "\" is not a time like 500ms, 60s, 1.5m or 2h");
}

std::optional<RenderOptions> parse_render_options(const Arguments& arguments) {
  CLI::App app(
      "Renders a scene. Without a budget, the sampler's default number of samples is made;\n"
      "of several budgets, the one that is reached first ends the render.",
      "pssmlt render");
  RenderOptions o;
  RawOptions raw;
  add_scene_options(app, o, raw);
  add_budget_options(app, o, raw);
  add_output_options(app, o, raw);
  add_view_options(app, o);
  if (!parse_arguments(app, arguments)) return std::nullopt;
  understand_scene_options(o, raw);
  understand_budget_options(app, o, raw);
  if (!raw.aux.empty()) o.auxiliary = parse_auxiliary(raw.aux);
  return o;
}

}  // namespace pssmlt
