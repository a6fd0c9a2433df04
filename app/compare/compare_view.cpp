#include "app/compare/compare_view.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/compare/text.h"
#include "app/metrics/metrics.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr double status_interval = 0.25;   // [s]
constexpr double last_word_seconds = 5.0;  // for pages to take the end and all pictures [s]
constexpr const char* json_type = "application/json";
constexpr const char* script_type = "text/javascript; charset=utf-8";

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

json techniques_json(const RunView& run) {
  const size_t relmse = metric_index("relmse");
  json list = json::array();
  for (size_t t = 0; t < run.records.size(); ++t) {
    json one = {{"name", (*run.techniques)[t].name}, {"elapsed", run.elapsed[t]}};
    if (!run.records[t]->points.empty()) {
      const RunPoint& last = run.records[t]->points.back();
      one["seconds"] = last.seconds;
      one["relmse"] = last.metrics[relmse];
      one["estimate"] = last.estimate_known ? json(last.estimate) : json();
    }
    list.push_back(std::move(one));
  }
  return list;
}

double fraction_of(const RunView& run) {
  double done = 0.0;
  for (const double s : run.elapsed) done += std::min(s, run.seconds);
  return done / (run.seconds * static_cast<double>(run.elapsed.size()));
}

std::vector<RunRecord> copy(const RunView& run) {
  std::vector<RunRecord> records;
  for (const RunRecord* r : run.records) records.push_back(*r);
  return records;
}

// The points of a run that the curves do not hold yet.
void add_running(json& scene, const RunView& run) {
  for (size_t t = 0; t < run.records.size(); ++t) {
    json& points = scene["techniques"][t]["running"] = json::array();
    for (const RunPoint& p : run.records[t]->points) points.push_back(to_json(p));
  }
}

}  // namespace

CompareView::CompareView(const CompareOptions& options, const std::vector<SceneReport>& scenes,
                         std::atomic<bool>& stop)
    : options_(options), scenes_(scenes) {
  status_ = {{"state", "checking"}, {"scene", options.scenes.front().name},
             {"number", 1},         {"scenes", options.scenes.size()},
             {"data", 0},           {"final", false}};
  server_ = serve(options.page, report_live_files(), status_, stop);
}

void CompareView::show_state(const std::string& state, int index) {
  status_["state"] = state;
  status_["scene"] = options_.scenes[static_cast<size_t>(index)].name;
  status_["number"] = index + 1;
  status_["fraction"] = 0.0;
  for (const char* key : {"run", "techniques", "seconds", "of"}) status_.erase(key);
  publish(nullptr);
}

bool CompareView::due() {
  if (!server_ || now() < next_) return false;
  next_ = now() + status_interval;
  return true;
}

void CompareView::show_reference(double seconds, double of) {
  if (!due()) return;
  status_["state"] = "reference";
  status_["seconds"] = seconds;
  status_["of"] = of;
  status_["fraction"] = std::min(1.0, seconds / of);
  publish(nullptr);
}

void CompareView::show_run(const RunView& run) {
  size_t points = 0;
  for (const RunRecord* r : run.records) points += r->points.size();
  const bool more = points != points_;
  stale_ = stale_ || more;
  points_ = points;
  if (!due() && !more) return;
  status_["state"] = "running";
  status_["run"] = run.run + 1;
  status_["runs"] = run.runs;
  status_["of"] = run.seconds;
  status_["fraction"] = fraction_of(run);
  status_["techniques"] = techniques_json(run);
  publish(&run);
}

void CompareView::results_changed() {
  stale_ = true;
  points_ = 0;
  publish(nullptr);
}

void CompareView::finish(int exit_code, const std::string& why_partial) {
  if (!server_) return;
  status_["state"] = "finished";
  status_["final"] = true;
  status_["fraction"] = 1.0;
  status_["exit_code"] = exit_code;
  status_["report"] = (fs::path(options_.output) / "index.html").string();
  why_partial_ = why_partial;
  stale_ = true;
  publish(nullptr);
  server_->drain(last_word_seconds);
}

// Data first: the status says that they are there.
void CompareView::publish(const RunView* run) {
  if (!server_) return;
  if (stale_ && server_->watched()) publish_data(run);
  status_["data"] = data_version_;
  server_->publish(status_);
}

void CompareView::publish_data(const RunView* run) {
  const json data = report(run);
  for (const json& scene : data["scenes"]) {
    publish_image(scene["reference"]["image"]);
    for (const json& technique : scene["techniques"]) {
      for (const json& image : technique["images"]) publish_image(image["image"]);
    }
  }
  server_->publish_file({"/data.json", json_type, report_page_data(data)});
  ++data_version_;
  stale_ = false;
}

// From the report's folder when it is asked for: pictures are too large to be kept. The file's name
// is made here, from names that the comparison gave; requests only choose among them.
void CompareView::publish_image(const std::string& id) {
  if (report_id(id) != id || !images_.insert(id).second) return;
  const std::string name = "images/" + id + ".js",
                    file = (fs::path(options_.output) / name).string();
  server_->publish_file("/" + name, script_type, [file] { return read_file(file); });
}

// A first run is shown as far as it is; later ones beside the curves of those that are complete.
json CompareView::report(const RunView* run) const {
  if (run == nullptr || scenes_.empty()) return report_json(options_, scenes_, why_partial_);
  if (!scenes_.back().runs.empty()) {
    json data = report_json(options_, scenes_, why_partial_);
    add_running(data["scenes"].back(), *run);
    return data;
  }
  std::vector<SceneReport> scenes = scenes_;
  SceneReport& s = scenes.back();
  s.runs.push_back(copy(*run));
  s.result = analyse(s.runs, s.reference.floor, options_.seconds);
  return report_json(options_, scenes, why_partial_);
}

}  // namespace pssmlt::compare
