#include "app/stress/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/compare/machine.h"

namespace pssmlt::stress {
namespace {

using nlohmann::json;

std::string name_of(const Pair& pair) {
  if (pair.integrator.empty()) return pair.sampler.empty() ? "once" : pair.sampler;
  return pair.sampler + "(" + pair.integrator + ")";
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.2g}", *value) : "";
}

// What the line of a case's value says about its pairs.
struct Summary {
  Totals totals;
  const Entry* worst = nullptr;  // by deviation over tolerance
  uint64_t dropped = 0;
  std::optional<double> least_speed, least_acceptance;
  std::optional<uint64_t> longest_stuck;
};

double share(const Outcome& o) {
  if (!o.deviation || !o.tolerance) return -1.0;
  return *o.tolerance > 0.0 ? *o.deviation / *o.tolerance : *o.deviation > 0.0 ? 1e300 : 0.0;
}

template <typename T>
void keep(std::optional<T>& kept, const std::optional<T>& value, bool smaller) {
  if (!value || (kept && (*kept < *value) == smaller)) return;
  kept = value;
}

Summary summary(const std::vector<const Entry*>& entries) {
  Summary s;
  std::vector<Entry> copies;
  for (const Entry* const e : entries) {
    const Outcome& o = e->outcome;
    copies.push_back(*e);
    s.dropped += o.dropped;
    if (!s.worst || share(o) > share(s.worst->outcome)) s.worst = e;
    keep(s.least_speed, o.relative_speed, true);
    keep(s.least_acceptance, o.acceptance, true);
    keep(s.longest_stuck, o.longest_stuck, false);
  }
  s.totals = count(copies);
  return s;
}

std::string line(const Case& c, const Point& point, const Summary& s) {
  const Totals& t = s.totals;
  const size_t open = t.undecided + t.not_run;
  const Outcome& worst = s.worst->outcome;
  return fmt::format("{:<22} {:>10} {:>5} {:>5} {:>5} {:>5}  {:>8} {:>8} {:>6} {:>6} {:>6} {:>8}\n",
                     c.name, point.value, t.pass, t.fail, t.cannot_see, open,
                     number(worst.deviation), number(worst.tolerance), s.dropped,
                     number(s.least_speed), number(s.least_acceptance),
                     s.longest_stuck ? std::to_string(*s.longest_stuck) : "");
}

std::string listed(const Cases& cases, const std::vector<Entry>& entries, Verdict verdict) {
  std::string text;
  for (const Entry& e : entries) {
    if (e.outcome.verdict != verdict) continue;
    const Case& c = cases[e.of_case];
    text +=
        fmt::format("{}: {} {} {}{}{}\n", to_string(verdict), c.name, c.points[e.of_point].value,
                    name_of(e.pair), e.outcome.reason.empty() ? "" : ": ", e.outcome.reason);
  }
  return text;
}

// What was not run, a line a case.
std::string listed_not_run(const Cases& cases, const std::vector<Entry>& entries) {
  std::string text;
  for (size_t c = 0; c < cases.size(); ++c) {
    const auto missing = std::ranges::count_if(entries, [c](const Entry& e) {
      return e.of_case == c && e.outcome.verdict == Verdict::not_run;
    });
    if (missing > 0) text += fmt::format("not run: {}: {} entries\n", cases[c].name, missing);
  }
  return text;
}

json optional_json(const auto& value) { return value ? json(*value) : json(nullptr); }

json entry_json(const Entry& e) {
  const Outcome& o = e.outcome;
  return {{"integrator", e.pair.integrator},
          {"sampler", e.pair.sampler},
          {"verdict", to_string(o.verdict)},
          {"reason", o.reason},
          {"deviation", optional_json(o.deviation)},
          {"tolerance", optional_json(o.tolerance)},
          {"meaning", o.meaning},
          {"dropped", o.dropped},
          {"relative_speed", optional_json(o.relative_speed)},
          {"acceptance", optional_json(o.acceptance)},
          {"longest_stuck", optional_json(o.longest_stuck)},
          {"seconds", o.seconds}};
}

}  // namespace

Totals count(const std::vector<Entry>& entries) {
  Totals t;
  for (const Entry& e : entries) {
    switch (e.outcome.verdict) {
      case Verdict::pass:
        ++t.pass;
        break;
      case Verdict::fail:
        ++t.fail;
        break;
      case Verdict::cannot_see:
        ++t.cannot_see;
        break;
      case Verdict::undecided:
        ++t.undecided;
        break;
      case Verdict::not_run:
        ++t.not_run;
        break;
    }
  }
  return t;
}

int exit_code(const Totals& totals) {
  if (totals.fail > 0) return 1;
  return totals.undecided + totals.not_run > 0 ? 3 : 0;
}

std::string terminal_table(const Cases& cases, const std::vector<Entry>& entries) {
  std::string text =
      fmt::format("{:<22} {:>10} {:>5} {:>5} {:>5} {:>5}  {:>8} {:>8} {:>6} {:>6} {:>6} {:>8}\n",
                  "case", "value", "pass", "fail", "blind", "open", "deviat.", "toler.", "dropped",
                  "speed", "accept", "stuck");
  for (size_t c = 0; c < cases.size(); ++c) {
    for (size_t p = 0; p < cases[c].points.size(); ++p) {
      std::vector<const Entry*> here;
      for (const Entry& e : entries) {
        if (e.of_case == c && e.of_point == p) here.push_back(&e);
      }
      if (!here.empty()) text += line(cases[c], cases[c].points[p], summary(here));
    }
  }
  text += listed(cases, entries, Verdict::fail) + listed(cases, entries, Verdict::undecided) +
          listed_not_run(cases, entries);
  const Totals t = count(entries);
  return text + fmt::format("{} pass, {} fail, {} cannot see, {} undecided, {} not run\n", t.pass,
                            t.fail, t.cannot_see, t.undecided, t.not_run);
}

json result_data(const Cases& cases, const std::vector<Entry>& entries, const std::string& command,
                 double seconds) {
  const Totals t = count(entries);
  json data = {{"format", 1},
               {"command", command},
               {"program", compare::program_json()},
               {"machine", compare::machine_json()},
               {"time", compare::time_stamp()},
               {"seconds", seconds},
               {"false_alarm", false_alarm_of_all},
               {"totals",
                {{"pass", t.pass},
                 {"fail", t.fail},
                 {"cannot_see", t.cannot_see},
                 {"undecided", t.undecided},
                 {"not_run", t.not_run}}},
               {"cases", json::array()}};
  for (size_t c = 0; c < cases.size(); ++c) {
    json points = json::array();
    for (size_t p = 0; p < cases[c].points.size(); ++p) {
      json runs = json::array();
      for (const Entry& e : entries) {
        if (e.of_case == c && e.of_point == p) runs.push_back(entry_json(e));
      }
      points.push_back({{"value", cases[c].points[p].value}, {"runs", runs}});
    }
    data["cases"].push_back({{"group", cases[c].group},
                             {"name", cases[c].name},
                             {"about", cases[c].about},
                             {"points", points}});
  }
  return data;
}

}  // namespace pssmlt::stress
