// pssmlt compare: techniques on scenes at equal wall time, and a report about them.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "app/compare/compare_view.h"
#include "app/compare/machine.h"
#include "app/compare/reference_cache.h"
#include "app/compare/run_store.h"
#include "app/compare/terminal.h"
#include "app/compare/text.h"
#include "app/signals.h"
#include "core/base/log.h"
#include "core/render/checkpoint.h"
#include "core/render/session.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* stopping =
    "\ninterrupted: finishing the round, then writing the report; again to leave at once\n";

// Everything that could be refused is, before anything is rendered or written. Returns what
// finished runs belong to.
json check_scenes(const CompareOptions& o) {
  json identity = {{"program", program_json()["version"]},
                   {"seconds", o.seconds},
                   {"snapshots", o.snapshots},
                   {"slice", o.slice},
                   {"seed", o.seed},
                   {"threads", o.threads},
                   {"techniques", json::array()},
                   {"scenes", json::array()}};
  for (const Technique& t : o.techniques) identity["techniques"].push_back(t.name);
  for (const SceneRequest& request : o.scenes) {
    const LoadedScene scene = load_scene(request, o.techniques.front());
    json settings = json::array();
    for (const Technique& t : o.techniques) {
      const BuiltScene built = scene.with(t, request.build);
      settings.push_back(built.settings_hash);
      // The session says whether sampler and integrator go together.
      RenderSettings one;
      one.threads = 1;
      const RenderCallbacks none;
      (void)Session(built, one, none);
    }
    if (request.reference.empty()) {
      for (const Technique& t : o.reference_techniques) (void)scene.with(t, request.build);
    } else {
      (void)read_reference(request.reference, scene.built.raster_map->frame().crop_size());
    }
    identity["scenes"].push_back({{"content", scene.content_hash}, {"settings", settings}});
  }
  for (int i = 0; i < 2; ++i) {
    if (reference_seed(i) - o.seed < static_cast<uint64_t>(o.runs)) {
      throw Error("--seed: this seed belongs to the references");
    }
  }
  return identity;
}

uint64_t hash_image(const Image& image) {
  return hash_bytes(image.data.data(), image.data.size() * sizeof(float));
}

class Compare {
 public:
  explicit Compare(CompareOptions options)
      : o_(std::move(options)),
        view_(o_, reports_, stop_requested()),
        identity_(check_scenes(o_)),
        writer_(o_.output),
        store_(o_.output, identity_, o_.resume),
        display_(!o_.quiet) {}
  int run();

 private:
  void compare_scene(int index);
  std::optional<Reference> find_reference(int index, const LoadedScene& scene);
  void describe(int index, const LoadedScene& scene, Reference reference);
  void run_all(int index, const LoadedScene& scene, const Reference& reference);
  void write(const std::string& why_partial);
  static bool stopped() { return stop_requested().load(std::memory_order_relaxed); }

  CompareOptions o_;
  std::vector<SceneReport> reports_;
  CompareView view_;
  json identity_;
  ReportWriter writer_;
  RunStore store_;
  RunDisplay display_;
};

std::optional<Reference> Compare::find_reference(int index, const LoadedScene& scene) {
  const SceneRequest& request = o_.scenes[static_cast<size_t>(index)];
  if (!request.reference.empty()) {
    return read_reference(request.reference, scene.built.raster_map->frame().crop_size());
  }
  view_.show_state("reference", index);
  ReferenceRequest wanted;
  wanted.techniques = o_.reference_techniques;
  wanted.seconds = o_.reference_seconds;
  wanted.threads = o_.threads;
  wanted.slice = o_.slice;
  wanted.stop = &stop_requested();
  wanted.progress = [&](double seconds) {
    display_.show_reference(request.name, seconds, o_.reference_seconds);
    view_.show_reference(seconds, o_.reference_seconds);
  };
  std::optional<Reference> reference = make_reference(scene, request.build, wanted);
  display_.clear();
  if (!reference || !reference->agreement) return reference;
  if (reference->agreement->biased) {
    log_warning("reference of " + request.name + ": " + reference->agreement->text);
  } else {
    log_info("reference of " + request.name + ": " + reference->agreement->text);
  }
  return reference;
}

// The scene's part of the report but for its runs.
void Compare::describe(int index, const LoadedScene& scene, Reference reference) {
  const SceneRequest& request = o_.scenes[static_cast<size_t>(index)];
  SceneReport& s = reports_.emplace_back();
  s.name = request.name;
  s.file = request.file;
  s.hash = fmt::format("{:016x}", scene.content_hash);
  s.width = reference.image.width;
  s.height = reference.image.height;
  s.load_seconds = scene.load_seconds;
  s.warnings = scene.built.warnings;
  s.reference_image = fmt::format("scene{}-reference", index);
  for (const Technique& t : o_.techniques) {
    const BuiltScene built = scene.with(t, request.build);
    s.parameters.push_back(parameters_json(built.layers));
    s.integrators.push_back(integrator_names(built.layers));
    s.samplers.push_back(sampler_names(built.layers));
  }
  writer_.add_image(s.reference_image, reference.image, ReportWriter::Precision::exact);
  reference.image = reference.half[0] = reference.half[1] = {};
  s.reference = std::move(reference);
  view_.results_changed();
}

void Compare::run_all(int index, const LoadedScene& scene, const Reference& reference) {
  const uint64_t hash = hash_image(reference.image);
  SceneReport& s = reports_.back();
  Contest contest(o_, index, scene, reference, writer_);
  for (int run = 0; run < o_.runs && !stopped(); ++run) {
    std::optional<std::vector<RunRecord>> records = store_.load(index, run, hash);
    bool cut = false;
    if (!records) {
      const auto* first = s.runs.empty() ? nullptr : &s.runs.front();
      const auto show = [this](const RunView& v) {
        display_.show(v);
        view_.show_run(v);
      };
      records = contest.run(run, first, stop_requested(), show, cut);
      display_.clear();
      if (!cut) store_.save(index, run, hash, *records);
    }
    // A run that was cut is shown only where there is nothing else.
    if (!cut || s.runs.empty()) s.runs.push_back(std::move(*records));
    s.result = analyse(s.runs, s.reference.floor, o_.seconds);
    view_.results_changed();
    if (!stopped()) write("the comparison is still running, or was killed");
  }
}

void Compare::compare_scene(int index) {
  const SceneRequest& request = o_.scenes[static_cast<size_t>(index)];
  view_.show_state("loading", index);
  const LoadedScene scene = load_scene(request, o_.techniques.front());
  log_info(fmt::format("{}: loaded in {:.3g} s", request.name, scene.load_seconds));
  const std::optional<Reference> reference = find_reference(index, scene);
  if (!reference) return;  // interrupted
  describe(index, scene, *reference);
  run_all(index, scene, *reference);
  if (reports_.back().runs.empty()) {
    reports_.pop_back();  // interrupted before there was anything to show
  } else if (!o_.quiet) {
    std::fputs(scene_table(o_, reports_.back()).c_str(), stdout);
    std::fflush(stdout);
  }
}

void Compare::write(const std::string& why_partial) {
  write_file((fs::path(o_.output) / "curves.csv").string(), curves_csv(o_, reports_));
  writer_.finish(report_json(o_, reports_, why_partial));
}

int Compare::run() {
  for (size_t i = 0; i < o_.scenes.size() && !stopped(); ++i) compare_scene(static_cast<int>(i));
  std::string why;
  if (stopped()) {
    const size_t runs = reports_.empty() ? 0 : reports_.back().runs.size();
    why = reports_.empty()
              ? "interrupted before the first run"
              : fmt::format("interrupted in scene {} of {} ({}), of which {} of {} runs are shown",
                            reports_.size(), o_.scenes.size(), reports_.back().name, runs, o_.runs);
  }
  write(why);
  if (!o_.quiet) std::fputs(suite_table(o_, reports_).c_str(), stdout);
  if (!why.empty()) log_warning(why + "; --resume continues");
  log_info("wrote " + (fs::path(o_.output) / "index.html").string());
  const int code = why.empty() ? 0 : exit_interrupted;
  view_.finish(code, why);
  return code;
}

}  // namespace
}  // namespace pssmlt::compare

namespace pssmlt {

int run_compare(const Arguments& arguments) {
  std::optional<compare::CompareOptions> options = compare::parse_compare_options(arguments);
  if (!options) return 0;
  set_log_level(options->quiet     ? LogLevel::quiet
                : options->verbose ? LogLevel::verbose
                                   : LogLevel::normal);
  for (const std::string& note : options->notes) log_info(note);
  catch_signals(compare::stopping);
  return compare::Compare(std::move(*options)).run();
}

}  // namespace pssmlt
