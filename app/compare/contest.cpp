#include "app/compare/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/compare/session_racer.h"
#include "app/compare/snapshot_times.h"
#include "app/compare/text.h"
#include "app/metrics/metrics.h"
#include "core/base/log.h"

namespace pssmlt::compare {

// A technique in a run.
struct Contest::Entrant {
  int technique = 0;
  bool keeps_images = false;
  std::unique_ptr<SessionRacer> racer;
  std::optional<SnapshotClock> clock;  // made after the first round
  RunRecord record;
};

Contest::Contest(const CompareOptions& options, int index, const LoadedScene& scene,
                 const Reference& reference, ReportWriter& writer)
    : options_(options), index_(index), scene_(scene), reference_(reference), writer_(writer) {}

std::string final_image_name(const std::string& scene, const std::string& technique) {
  return plain_name(scene) + "-" + plain_name(technique) + ".exr";
}

// In the order of the techniques.
std::vector<std::unique_ptr<Contest::Entrant>> Contest::enter(int run,
                                                              const std::vector<RunRecord>* first) {
  std::vector<std::unique_ptr<Entrant>> entrants;
  const BuildOptions& base = options_.scenes[static_cast<size_t>(index_)].build;
  for (size_t t = 0; t < options_.techniques.size(); ++t) {
    auto entrant = std::make_unique<Entrant>();
    entrant->technique = static_cast<int>(t);
    entrant->keeps_images = first == nullptr;
    RenderSettings settings;
    settings.seconds = options_.seconds;  // no budget of samples
    settings.threads = options_.threads;
    settings.seed = options_.seed + static_cast<uint64_t>(run);
    entrant->record.seed = settings.seed;
    if (first != nullptr) entrant->record.nominal = (*first)[t].nominal;
    entrant->racer = std::make_unique<SessionRacer>(
        scene_.with(options_.techniques[t], base), settings,
        [this, e = entrant.get()](SessionRacer&) { after_round(*e); });
    entrants.push_back(std::move(entrant));
  }
  return entrants;
}

void Contest::after_round(Entrant& e) {
  const double elapsed = e.racer->elapsed();
  const bool first_round = !e.clock;
  if (first_round) {
    RunRecord& r = e.record;
    if (r.nominal.empty())
      r.nominal = snapshot_times(options_.seconds, options_.snapshots, elapsed);
    e.clock.emplace(r.nominal);
  }
  const std::optional<double> due = e.clock->due(elapsed);
  // The first round's end is a point too: curves are interpolated from there on.
  if (due || first_round) take_point(e, due.value_or(elapsed), e.clock->last_taken());
}

void Contest::take_point(Entrant& e, double nominal, bool last) {
  const RenderResult result = e.racer->session().result(last);
  const pssmlt::Comparison errors =
      compare_images(result.image, reference_.image, {}, options_.threads);
  RunPoint p;
  p.nominal = nominal;
  p.seconds = result.seconds;
  p.samples = result.samples;
  const nlohmann::json& rays = result.statistics["rays"];
  p.rays = rays["nearest"].get<double>() + rays["shadow"].get<double>();
  p.metrics = errors.values;
  p.mean_bias = errors.mean_bias;
  const ErrorEstimate& estimate = result.error;
  if (estimate.mean_known && estimate.mean > 0.0) {
    // Relative to the reference's mean, as the bias is; the reference's own error belongs to it.
    const double own = estimate.mean_error / estimate.mean * (1.0 + errors.mean_bias);
    p.mean_bias_error = std::hypot(own, reference_.mean_error.value_or(0.0));
  }
  p.estimate_known = estimate.known;
  p.estimate = estimate.relative_mse;
  p.estimate_low = estimate.low;
  p.estimate_high = estimate.high;
  e.record.points.push_back(std::move(p));
  e.record.statistics = result.statistics;
  if (last) {
    const std::string& name = options_.techniques[static_cast<size_t>(e.technique)].name;
    for (const std::string& warning : result.warnings) log_warning(name + ": " + warning);
  }
  if (e.keeps_images) keep_image(e, result, last);
}

// The picture that there is stands for the last one.
void Contest::end_early(Entrant& e) {
  if (!e.racer->has_picture() || e.clock->last_taken()) return;
  const double elapsed = e.racer->elapsed();
  if (e.record.points.back().seconds == elapsed) {  // taken as one of those before the last
    e.record.points.pop_back();
    if (e.keeps_images) e.record.images.pop_back();
  }
  take_point(e, elapsed, true);
}

void Contest::keep_image(Entrant& e, const RenderResult& result, bool last) {
  const std::string id =
      fmt::format("scene{}-technique{}-{}", index_, e.technique, e.record.images.size());
  writer_.add_image(id, result.image,
                    last ? ReportWriter::Precision::exact : ReportWriter::Precision::logarithmic);
  e.record.images.push_back({result.seconds, id, last});
  if (!last) return;
  const std::string name =
      final_image_name(options_.scenes[static_cast<size_t>(index_)].name,
                       options_.techniques[static_cast<size_t>(e.technique)].name);
  write_image((std::filesystem::path(options_.output) / "images" / name).string(), result.image,
              {{"software", "pssmlt " PSSMLT_VERSION},
               {"pssmlt:seed", std::to_string(e.record.seed)},
               {"pssmlt:seconds", fmt::format("{:.3f}", result.seconds)}},
              {});
}

std::vector<RunRecord> Contest::run(int run, const std::vector<RunRecord>* first,
                                    const std::atomic<bool>& stop,
                                    const std::function<void(const RunView&)>& watch, bool& cut) {
  auto entrants = enter(run, first);
  const int count = static_cast<int>(entrants.size());
  std::vector<Racer*> racers;
  for (int i = 0; i < count; ++i) {
    racers.push_back(entrants[static_cast<size_t>(rotated(i, run, count))]->racer.get());
  }
  const auto after_slice = [&] {
    if (!watch) return;
    RunView view{.scene = &options_.scenes[static_cast<size_t>(index_)].name,
                 .run = run,
                 .runs = options_.runs,
                 .seconds = options_.seconds,
                 .techniques = &options_.techniques,
                 .records = {},
                 .elapsed = {}};
    for (const auto& e : entrants) {
      view.records.push_back(&e->record);
      view.elapsed.push_back(e->racer->elapsed());
    }
    watch(view);
  };
  cut = !interleave(
      racers, {options_.seconds, options_.slice},
      [&stop] { return stop.load(std::memory_order_relaxed); }, after_slice);
  std::vector<RunRecord> records;
  for (const auto& e : entrants) {
    if (cut) end_early(*e);
    records.push_back(std::move(e->record));
  }
  return records;
}

}  // namespace pssmlt::compare
