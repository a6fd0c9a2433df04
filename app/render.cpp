// pssmlt render: scene in, pictures out.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "app/live/render_view.h"
#include "app/progress.h"
#include "app/read_scene.h"
#include "app/render_options.h"
#include "app/render_record.h"
#include "app/signals.h"
#include "app/summary.h"
#include "core/base/log.h"
#include "core/image/texel_store.h"
#include "core/render/auxiliary.h"
#include "core/render/output.h"
#include "core/render/replay.h"

namespace pssmlt {
namespace {

constexpr int exit_done = 0, exit_failure = 1;
constexpr int traced_samples = 4;  // of --pixel, unless --spp says otherwise

constexpr const char* stopping =
    "\ninterrupted: finishing the round, then writing; again to leave at once without writing\n";

bool wants(const RenderOptions& o, const std::string& auxiliary) {
  return std::find(o.auxiliary.begin(), o.auxiliary.end(), auxiliary) != o.auxiliary.end();
}

// Fills in what the scene says and finds out now what could not be written later.
void prepare_outputs(RenderOptions& o, const BuiltScene& scene) {
  if (o.outputs.empty()) o.outputs = {scene.output.empty() ? "pssmlt.exr" : scene.output};
  for (const std::string& path : o.outputs) check_writable(path);
  const auto& outputs = o.outputs;
  if (o.auxiliary.empty() && std::ranges::any_of(outputs, holds_layers)) {
    o.auxiliary = scene.film_layers;
  }
  if (!o.auxiliary.empty() && std::none_of(outputs.begin(), outputs.end(), holds_layers)) {
    throw Error("--aux needs an EXR among the outputs: other formats hold no layers");
  }
  if (o.render.checkpoint.empty() && o.render.resume) {
    o.render.checkpoint = o.outputs.front() + ".checkpoint";
  }
  for (const std::string& path : {o.render.checkpoint, o.json}) {
    if (path.empty()) continue;
    const bool fresh = !std::filesystem::exists(path);
    std::ofstream probe(path, std::ios::app);  // does not touch what is there
    if (!probe) throw Error("cannot write \"" + path + "\"");
    probe.close();
    if (fresh) std::remove(path.c_str());
  }
}

BuiltScene load(RenderOptions& o) {
  std::vector<std::string> log;
  const auto start = std::chrono::steady_clock::now();
  const SceneDescription description = read_scene(o.scene, &log);
  set_texture_cache(o.texture_cache);
  BuiltScene scene = build_scene(description, o.build);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  for (const std::string& line : log) log_info(line);
  for (const std::string& line : scene.log) log_info(line);
  for (const std::string& line : scene.warnings) log_warning(line);
  for (const std::string& line : o.notes) log_info(line);
  log_debug(fmt::format("scene loaded in {:.3f} s", spent.count()));
  o.render.seed = o.seed.value_or(scene.seed.value_or(0));
  return scene;
}

ImageMetadata metadata(const RenderOptions& o, const BuiltScene& scene, const RenderResult& r) {
  return to_metadata(make_record(o.scene, scene, o.render.seed, r));
}

// The images beside the picture that --aux asks for.
struct Companions {
  AuxiliaryImages first_hit;
  Image error;
};

Companions make_companions(const RenderOptions& o, const BuiltScene& scene,
                           const RenderResult& result) {
  Companions c;
  if (wants(o, "albedo") || wants(o, "normal") || wants(o, "depth")) {
    c.first_hit = render_auxiliary(scene, o.render.seed, o.render.threads);
  }
  if (wants(o, "error") && !result.variance.data.empty()) c.error = error_image(result.variance);
  return c;
}

Image with_companions(const RenderOptions& o, const RenderResult& result, const Companions& c) {
  std::vector<std::pair<std::string, const Image*>> layers = {{"", &result.image}};
  if (wants(o, "halves")) {
    layers.emplace_back("half0", &result.half[0]);
    layers.emplace_back("half1", &result.half[1]);
  }
  if (wants(o, "variance")) layers.emplace_back("variance", &result.variance);
  if (wants(o, "albedo")) layers.emplace_back("albedo", &c.first_hit.albedo);
  if (wants(o, "normal")) layers.emplace_back("normal", &c.first_hit.normal);
  if (wants(o, "depth")) layers.emplace_back("depth", &c.first_hit.depth);
  if (wants(o, "error")) layers.emplace_back("error", &c.error);
  return join_layers(layers);
}

// False if a file could not be written where it was asked for.
bool write_outputs(const RenderOptions& o, const BuiltScene& scene, const RenderResult& result,
                   const Companions& companions) {
  const ImageMetadata data = metadata(o, scene, result);
  const DisplaySettings display{o.view};
  bool fine = true;
  for (const std::string& path : o.outputs) {
    const bool layered = holds_layers(path) && !o.auxiliary.empty();
    fine &= layered ? write_or_rescue(path, with_companions(o, result, companions), data, display)
                    : write_or_rescue(path, result.image, data, display);
    for (const SplitImage& split : result.splits) {
      fine &= write_or_rescue(with_suffix(path, split.name), split.image, data, display);
    }
  }
  if (!result.complete) return fine;
  if (result.half[0].data.empty() &&
      (wants(o, "halves") || wants(o, "variance") || wants(o, "error"))) {
    log_warning("halves, variance and error are left out: they need two rounds at least");
  } else if (result.variance.data.empty() && (wants(o, "variance") || wants(o, "error"))) {
    log_warning("variance and error are left out: the error is unknown, " + result.error.why);
  }
  return fine;
}

bool write_json(const std::string& path, const nlohmann::json& statistics) {
  if (path.empty()) return true;
  std::ofstream file(path);
  file << statistics.dump(2) << "\n";
  file.close();
  if (!file) log_warning("cannot write \"" + path + "\"");
  return static_cast<bool>(file);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Writes pictures and statistics and prints the summary; the exit code.
int finish(const RenderOptions& o, const BuiltScene& scene, RenderResult& result) {
  const bool interrupted = result.stop == StopReason::interrupted;
  bool fine = true;
  nlohmann::json& s = result.statistics;
  if (result.complete) {
    auto start = std::chrono::steady_clock::now();
    const Companions companions = make_companions(o, scene, result);
    if (!o.auxiliary.empty()) s["seconds"]["auxiliary"] = seconds_since(start);
    start = std::chrono::steady_clock::now();
    fine = write_outputs(o, scene, result, companions);
    s["seconds"]["write"] = seconds_since(start);
  } else {
    log_warning("interrupted before a first round was complete: no picture is written");
  }
  s["version"] = PSSMLT_VERSION;
  s["scene"] = o.scene;
  s["outputs"] = o.outputs;
  fine &= write_json(o.json, s);
  log_info(summary_text(s));
  if (result.complete) {
    for (const std::string& path : o.outputs) log_info("wrote " + path);
  }
  return interrupted ? exit_interrupted : fine ? exit_done : exit_failure;
}

int inspect(const RenderOptions& o, const BuiltScene& scene) {
  const auto print = [](const std::string& line) { std::puts(line.c_str()); };
  if (!o.replay.empty()) {
    replay_sample(scene, o.replay, o.render.seed, print);
  } else {
    const double wanted = o.render.spp.value_or(traced_samples);
    trace_pixel(scene, *o.pixel, std::max(1, static_cast<int>(wanted)), o.render.seed, print);
  }
  return exit_done;
}

}  // namespace

int run_render(const Arguments& arguments) {
  std::optional<RenderOptions> options = parse_render_options(arguments);
  if (!options) return exit_done;
  RenderOptions& o = *options;
  set_log_level(o.quiet ? LogLevel::quiet : o.verbose ? LogLevel::verbose : LogLevel::normal);
  RenderView view(o.view_while, o.scene, stop_requested());
  const BuiltScene scene = load(o);
  if (o.pixel || !o.replay.empty()) return inspect(o, scene);
  prepare_outputs(o, scene);
  catch_signals(stopping);
  RenderResult result;
  {
    ProgressDisplay display(!o.quiet);
    RenderCallbacks callbacks;
    callbacks.stop = &stop_requested();
    callbacks.progress = [&display](const Progress& p) { display.show(p); };
    view.attach(callbacks);
    result = render(scene, o.render, callbacks);
  }
  result.warnings.insert(result.warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  view.show_result(result);
  const int code = finish(o, scene, result);
  view.finish(code, result.complete ? o.outputs : std::vector<std::string>());
  return code;
}

}  // namespace pssmlt
