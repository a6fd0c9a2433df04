#include "app/stress/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "app/defaults.h"
#include "app/stress/blindness.h"
#include "app/stress/oracle.h"
#include "app/stress/technique.h"
#include "core/plugin/registry.h"

namespace pssmlt::stress {
namespace {

// Of one comparison in rendering; what is in doubt then gets more, while the budget lasts.
constexpr double least_seconds = 1.0, most_seconds = 20.0;
constexpr double runs_of_a_budget = 400.0;
constexpr double more_when_in_doubt = 6.0;
// Blocks of a picture and the whole: how many comparisons one picture stands for.
constexpr double comparisons_a_picture = 5.0;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool is_chain(const std::string& sampler) {
  const FoundPlugin found = Registry::instance().find("sampler", sampler, {});
  const ParameterSet none;
  Parameters parameters(none, {}, "sampler \"" + sampler + "\"", nullptr);
  return make_plugin<Sampler>(found, parameters)->is_chain();
}

bool contains(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::cannot_see:
      return "cannot see";
    case Verdict::undecided:
      return "undecided";
    case Verdict::not_run:
      break;
  }
  return "not run";
}

Runner::Runner(const Cases& cases, RunnerOptions options)
    : cases_(cases), options_(std::move(options)) {}

double Runner::elapsed() const { return now() - start_; }

std::vector<Entry> Runner::grid() const {
  std::vector<Entry> entries;
  for (size_t c = 0; c < cases_.size(); ++c) {
    for (size_t p = 0; p < cases_[c].points.size(); ++p) {
      const Over over = cases_[c].over;
      const std::vector<std::string> none = {""};
      for (const std::string& i : over == Over::pairs ? options_.integrators : none)
        for (const std::string& s : over == Over::once ? none : options_.samplers)
          entries.push_back({c, p, {i, s}, {}});
    }
  }
  return entries;
}

// First what has to run: the extreme of each case under the default sampler and under chains. Then
// the extremes under the others, then the rest of each sweep, step by step.
std::vector<std::vector<size_t>> Runner::order(const std::vector<Entry>& entries) const {
  std::map<std::string, bool> first;
  for (const std::string& s : options_.samplers) {
    first[s] = s == default_plugins().sampler || is_chain(s);
  }
  std::vector<std::vector<size_t>> phases(2);
  for (size_t e = 0; e < entries.size(); ++e) {
    const Entry& entry = entries[e];
    const bool needed = entry.pair.sampler.empty() || first.at(entry.pair.sampler);
    const size_t phase = entry.of_point == 0 ? (needed ? 0 : 1) : entry.of_point + 1;
    if (phases.size() <= phase) phases.resize(phase + 1);
    phases[phase].push_back(e);
  }
  return phases;
}

std::vector<Entry> Runner::run() {
  start_ = now();
  std::vector<Entry> entries = grid();
  false_alarm_ = false_alarm_of_all / comparisons_a_picture /
                 static_cast<double>(std::max<size_t>(entries.size(), 1));
  seconds_a_run_ = std::clamp(options_.seconds / runs_of_a_budget, least_seconds, most_seconds);
  bool always = true;
  for (const std::vector<size_t>& phase : order(entries)) {
    run_entries(phase, always, entries);
    always = false;
  }
  decide_doubtful(entries);
  return entries;
}

void Runner::run_entries(const std::vector<size_t>& which, bool always,
                         std::vector<Entry>& entries) {
  for (const size_t e : which) {
    Entry& entry = entries[e];
    if (options_.stop() || (!always && elapsed() > options_.seconds)) return;
    const Case& c = cases_[entry.of_case];
    const Point& point = c.points[entry.of_point];
    if (options_.progress) {
      options_.progress(fmt::format("{} {} {} {}", c.name, point.value, entry.pair.integrator,
                                    entry.pair.sampler),
                        done_, entries.size());
    }
    entry.outcome = run_one(c, point, entry.pair, seconds_a_run_);
    ++done_;
  }
}

// More time for what was too noisy to decide, while there is any.
void Runner::decide_doubtful(std::vector<Entry>& entries) {
  for (double seconds = more_when_in_doubt * seconds_a_run_; seconds < options_.seconds;
       seconds *= more_when_in_doubt) {
    for (Entry& entry : entries) {
      if (entry.outcome.verdict != Verdict::undecided) continue;
      if (options_.stop() || elapsed() + seconds > options_.seconds) return;
      const Case& c = cases_[entry.of_case];
      entry.outcome = run_one(c, c.points[entry.of_point], entry.pair, seconds);
    }
  }
}

Outcome Runner::run_one(const Case& c, const Point& point, const Pair& pair, double seconds) {
  const double begin = now();
  Outcome outcome;
  if (const Probe* const probe = std::get_if<Probe>(&point.oracle)) {
    try {
      outcome = probe->run({pair, options_.program, false_alarm_, seconds, options_.threads});
    } catch (const std::exception& error) {
      outcome.verdict = Verdict::fail;
      outcome.reason = error.what();
    }
  } else {
    outcome = load_and_judge(c, point, pair, seconds);
  }
  outcome.seconds = now() - begin;
  return outcome;
}

Job Runner::job(const Case& c, const Point& point, const Pair& pair,
                const std::string& scene) const {
  Job job{.scene = scene,
          .pair = pair,
          .set = small_settings(pair, c.bootstrap),
          .seed = options_.seed,
          .threads = options_.threads};
  const std::string& classes = point.classes.empty() ? c.classes : point.classes;
  if (pair.integrator.empty()) return job;
  if (has_parameter("integrator", pair.integrator, "maxdepth")) {
    job.set.push_back("integrator.maxdepth=" + std::to_string(c.max_depth));
  }
  if (has_parameter("integrator", pair.integrator, "paths")) {
    job.set.push_back("integrator.paths=" + classes);
  }
  job.set.insert(job.set.end(), point.set.begin(), point.set.end());
  return job;
}

Outcome Runner::load_and_judge(const Case& c, const Point& point, const Pair& pair,
                               double seconds) {
  const Refused* const refused = std::get_if<Refused>(&point.oracle);
  Outcome outcome;
  try {
    Picture picture(job(c, point, pair, point.scene()));
    if (refused == nullptr) return judge(c, point, pair, seconds, picture);
    outcome.reason = "the scene is loaded, not refused with \"" + refused->message + "\"";
    outcome.verdict = Verdict::fail;
  } catch (const Error& error) {
    const bool expected =
        refused != nullptr && std::string(error.what()).find(refused->message) != std::string::npos;
    outcome.verdict = expected ? Verdict::pass : Verdict::fail;
    outcome.reason = error.what();
  } catch (const std::exception& failure) {
    outcome.verdict = Verdict::fail;
    outcome.reason = failure.what();
  }
  return outcome;
}

Outcome Runner::judge(const Case& c, const Point& point, const Pair& pair, double seconds,
                      Picture& picture) {
  Outcome outcome;
  const std::string& classes = point.classes.empty() ? c.classes : point.classes;
  const bool all = std::holds_alternative<Means>(point.oracle);
  outcome.reason = blindness(picture.scene(), classes, c.max_depth, all);
  if (outcome.reason.empty()) {
    outcome.reason = practical_blindness(point, picture.scene().layers.front());
  }
  if (!outcome.reason.empty()) {
    outcome.verdict = Verdict::cannot_see;
    return outcome;
  }
  const Polite& usual = polite(c, pair, seconds);
  if (const SameBits* const same = std::get_if<SameBits>(&point.oracle)) {
    picture.add(c.samples);
    const Comparison comparison = compare_bits(picture.image(), usual.image, same->factor);
    outcome.verdict = comparison.holds ? Verdict::pass : Verdict::fail;
    outcome.deviation = comparison.deviation;
    outcome.tolerance = 0.0;
    outcome.meaning = "bit by bit";
    if (!comparison.holds) outcome.reason = comparison.where;
    if (is_black(picture.blocks())) {
      outcome.verdict = Verdict::undecided;
      outcome.reason = "the picture is black";
    }
  } else {
    judge_statistics(c, point, pair, seconds, picture, outcome);
  }
  const RenderFigures figures = picture.figures();
  outcome.dropped = figures.dropped;
  outcome.acceptance = figures.acceptance;
  outcome.longest_stuck = figures.longest_stuck;
  if (usual.rays_per_second > 0.0) {
    outcome.relative_speed = figures.rays_per_second / usual.rays_per_second;
  }
  const auto told = [&](const std::string& what) {
    return figures.causes.find(what) != std::string::npos;
  };
  if (point.drops.empty() ? figures.dropped > 0
                          : std::ranges::none_of(point.drops, told) || !told(point.culprit)) {
    outcome.verdict = Verdict::fail;
    outcome.reason +=
        fmt::format("{}{} samples were dropped{}{}", outcome.reason.empty() ? "" : "; ",
                    figures.dropped, figures.causes.empty() ? "" : ": ", figures.causes);
  }
  for (const std::string& warning : point.warnings) {
    if (contains(picture.log(), warning)) continue;
    outcome.verdict = Verdict::fail;
    outcome.reason += (outcome.reason.empty() ? "" : "; ") + ("no warning \"" + warning + "\"");
  }
  return outcome;
}

void Runner::judge_statistics(const Case& c, const Point& point, const Pair& pair, double seconds,
                              Picture& picture, Outcome& outcome) {
  const auto compare = [&](const Blocks& blocks) {
    if (const Means* const m = std::get_if<Means>(&point.oracle)) {
      return compare_means(blocks, m->values, m->rounding, false_alarm_);
    }
    if (const AtMost* const limit = std::get_if<AtMost>(&point.oracle)) {
      return compare_limit(blocks, limit->most, false_alarm_);
    }
    const SameMeans& same = std::get<SameMeans>(point.oracle);
    return compare_blocks(blocks, polite(c, pair, seconds).blocks, same.factor, same.rounding,
                          false_alarm_);
  };
  const double demand = point.demand.value_or(c.demand);
  Comparison comparison;
  Blocks blocks;
  for (double samples = c.least_samples;; samples = picture.samples_per_pixel()) {
    picture.add(samples);
    blocks = picture.blocks();
    comparison = compare(blocks);
    const bool settled = comparison.widest <= demand || picture.seconds() > seconds;
    if (settled || options_.stop()) break;
  }
  outcome.deviation = comparison.deviation;
  outcome.tolerance = comparison.tolerance;
  outcome.meaning = meaning_of(blocks, false_alarm_);
  if (std::holds_alternative<SameMeans>(point.oracle) && is_black(blocks) &&
      is_black(polite(c, pair, seconds).blocks)) {
    outcome.verdict = Verdict::undecided;
    outcome.reason = "both pictures are black";
  } else if (!comparison.holds) {
    outcome.verdict = Verdict::fail;
    outcome.reason = comparison.where;
  } else if (!(comparison.widest <= demand)) {
    outcome.verdict = Verdict::undecided;
    outcome.reason =
        fmt::format("{:.2g} is the least deviation that would be found, {:.2g} is asked",
                    comparison.widest, demand);
  } else {
    outcome.verdict = Verdict::pass;
  }
}

// Rendered twice as precisely as the case asks for, once for every pair (and anew with more time).
const Runner::Polite& Runner::polite(const Case& c, const Pair& pair, double seconds) {
  Polite& p = polite_[c.name + '\n' + pair.integrator + '\n' + pair.sampler];
  if (p.seconds >= seconds) return p;
  Point last = c.points.back();
  if (c.polite) last.scene = c.polite, last.set.clear(), last.classes.clear();
  Job polite_job = job(c, last, pair, last.scene());
  polite_job.seed += 1;
  const bool bits = std::ranges::any_of(
      c.points, [](const Point& x) { return std::holds_alternative<SameBits>(x.oracle); });
  const bool means = std::ranges::any_of(
      c.points, [](const Point& x) { return std::holds_alternative<SameMeans>(x.oracle); });
  if (bits) polite_job.seed = options_.seed;
  Picture picture(polite_job);
  picture.add(bits ? c.samples : c.least_samples);
  if (bits) p.image = picture.image();
  for (; means && picture.seconds() < seconds; picture.add(picture.samples_per_pixel())) {
    const Blocks b = picture.blocks();
    if (compare_blocks(b, b, 1.0, 0.0, false_alarm_).widest < c.demand / 1.5) break;
  }
  if (means) p.blocks = picture.blocks();
  p.rays_per_second = picture.figures().rays_per_second;
  p.seconds = seconds;
  return p;
}

}  // namespace pssmlt::stress
