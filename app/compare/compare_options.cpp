#include "app/compare/compare_options.h"

#include "app/compare/snapshot_times.h"
#include "app/compare/text.h"
#include "app/defaults.h"
#include "app/parse_arguments.h"
#include "app/render_options.h"

namespace pssmlt::compare {
namespace {

constexpr const char* default_techniques = "path,bdpt,mlt";
// Both see all paths that bidirectional connections find; what differs is how u is explored.
constexpr const char* default_reference_techniques = "bdpt,mlt";

struct RawOptions {
  std::vector<std::string> scenes, techniques;
  std::string list, file, suite, size, crop, time = "60s", slice = "250ms";
  std::string reference, reference_time, reference_techniques = default_reference_techniques;
};

void add_technique_options(CLI::App& app, RawOptions& raw) {
  app.add_option("scenes", raw.scenes, "scene files");
  app.add_option("--suite", raw.suite, "file with one scene a line");
  app.add_option(
      "--techniques", raw.list,
      std::string("short names: path, bdpt, mlt, pssmlt(path), any integrator, scene (") +
          default_techniques + "); the others are compared with the first");
  app.add_option("--technique", raw.techniques,
                 "one more, e.g. \"mine=integrator:bdpt,maxdepth=8;sampler:pssmlt,sigma=0.02\"")
      ->allow_extra_args(false);
  app.add_option("--techniques-file", raw.file, "file with one technique a line, in either form");
}

void add_scene_options(CLI::App& app, CompareOptions& o, RawOptions& raw, BuildOptions& build) {
  app.add_option("--set", build.set, "parameter of all techniques, e.g. integrator.maxdepth=8")
      ->allow_extra_args(false);
  app.add_option("--size", raw.size, "size of the full picture, WIDTHxHEIGHT [pixels]");
  app.add_option("--scale", build.scale, "factor on the picture's size")
      ->check(CLI::PositiveNumber);
  app.add_option("--crop", raw.crop, "window x0,x1,y0,y1 [pixels], upper ends exclusive");
  app.add_option("--reference", raw.reference, "reference picture (one scene only)");
  app.add_option("--reference-time", raw.reference_time,
                 "wall time to make the reference, both techniques together (10 x --time)");
  app.add_option("--reference-techniques", raw.reference_techniques, "two techniques that make it")
      ->capture_default_str();
  app.add_option("-o,--output", o.output, "folder of the report (report)");
}

void add_run_options(CLI::App& app, CompareOptions& o, RawOptions& raw) {
  app.add_option("--time", raw.time, "wall time of every technique in every run (60s)");
  app.add_option("--runs", o.runs, "independent runs, with seeds that follow each other (4)")
      ->check(CLI::Range(1, 10000));
  app.add_option("--snapshots", o.snapshots, "pictures of a run, geometrically spaced (12)")
      ->check(CLI::Range(least_snapshots, 1000));
  app.add_option("--slice", raw.slice, "wall time of a turn when techniques take turns (250ms)");
  app.add_option("--threads", o.threads, "threads (all processors)")->check(CLI::Range(1, 1024));
  app.add_option("--seed", o.seed, "seed of the first run (0)")->check(CLI::NonNegativeNumber);
  app.add_flag("--resume", o.resume, "keep the finished runs that the report folder holds");
  const auto quiet = app.add_flag("--quiet", o.quiet, "print warnings and errors only");
  app.add_flag("--verbose", o.verbose, "print details")->excludes(quiet);
}

void collect_techniques(const RawOptions& raw, CompareOptions& o) {
  const auto add = [&o](std::vector<Technique> more) {
    std::move(more.begin(), more.end(), std::back_inserter(o.techniques));
  };
  if (!raw.list.empty()) add(parse_technique_list(raw.list));
  if (!raw.file.empty()) add(read_techniques(raw.file));
  for (const std::string& text : raw.techniques) add({parse_technique(text)});
  if (o.techniques.empty()) add(parse_technique_list(default_techniques));
  check_names_differ(o.techniques);
  o.reference_techniques = parse_technique_list(raw.reference_techniques);
  if (o.reference_techniques.size() != 2) {
    throw Error("--reference-techniques: must be two, as in bdpt,mlt");
  }
  check_names_differ(o.reference_techniques);
}

void collect_scenes(const RawOptions& raw, BuildOptions build, CompareOptions& o) {
  build.defaults = command_plugins();
  if (!raw.size.empty()) build.size = parse_size(raw.size);
  if (!raw.crop.empty()) build.crop = parse_crop(raw.crop);
  for (const std::string& file : raw.scenes) o.scenes.push_back(request_for(file, build));
  if (!raw.suite.empty()) {
    std::vector<SceneRequest> suite = read_suite(raw.suite, build);
    std::move(suite.begin(), suite.end(), std::back_inserter(o.scenes));
  }
  if (o.scenes.empty()) throw Error("name a scene, or a --suite of them");
  if (!raw.reference.empty()) {
    if (o.scenes.size() != 1) {
      throw Error("--reference goes with one scene; a suite's lines take reference=FILE");
    }
    o.scenes[0].reference = raw.reference;
  }
  make_names_differ(o.scenes);
}

// An argument as a shell reads it back.
std::string quoted(const std::string& argument) {
  static constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=:+@%";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_line(const Arguments& arguments) {
  std::string text = "pssmlt compare";
  for (const std::string& a : arguments) text += " " + quoted(a);
  return text;
}

}  // namespace

std::optional<CompareOptions> parse_compare_options(const Arguments& arguments) {
  CLI::App app(
      "Compares techniques on scenes at equal wall time: error curves, tables and pictures in a\n"
      "report folder. docs/compare.md says how it measures.",
      "pssmlt compare");
  CompareOptions o;
  RawOptions raw;
  BuildOptions build;
  o.output = "report";
  add_technique_options(app, raw);
  add_scene_options(app, o, raw, build);
  add_run_options(app, o, raw);
  add_live_options(app, o.page, "the report");
  if (!parse_arguments(app, arguments)) return std::nullopt;
  o.seconds = parse_duration(raw.time, o.notes);
  o.slice = parse_duration(raw.slice, o.notes);
  o.reference_seconds = raw.reference_time.empty() ? reference_factor * o.seconds
                                                   : parse_duration(raw.reference_time, o.notes);
  collect_techniques(raw, o);
  collect_scenes(raw, build, o);
  o.command = command_line(arguments);
  return o;
}

}  // namespace pssmlt::compare
