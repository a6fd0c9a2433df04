// The command's options, and a reduced run: the extreme of a case of most groups, by the default
// integrator, by the one that light tracing alone makes, and by chains.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/stress/report_page.h"
#include "app/stress/stress_options.h"
#include "app/stress/table.h"
#include "app/stress/technique.h"
#include "tests/support/reduced.h"

namespace pssmlt::stress {
namespace {

// The cases with their first point alone.
Cases extremes(const std::vector<std::string>& names) {
  Cases cases = chosen_cases(catalogue(), names);
  for (Case& c : cases) {
    if (!c.polite && c.points.back().scene) c.polite = c.points.back().scene;
    c.points.resize(1);
  }
  return cases;
}

std::vector<Entry> run(const Cases& cases, std::vector<std::string> integrators,
                       std::vector<std::string> samplers, double seconds = 1200.0) {
  RunnerOptions options;
  options.integrators = std::move(integrators);
  options.samplers = std::move(samplers);
  options.seconds = seconds;
  options.threads = 2;
  options.program = PSSMLT_BINARY;
  return Runner(cases, options).run();
}

std::string told(const Cases& cases, const Entry& e) {
  return cases[e.of_case].name + " " + e.pair.integrator + " " + e.pair.sampler + ": " +
         std::string(to_string(e.outcome.verdict)) + " " + e.outcome.reason;
}

TEST(StressOptions, ChooseCasesByNameAndGroup) {
  const Cases all = catalogue();
  EXPECT_EQ(chosen_cases(all, {}).size(), all.size());
  EXPECT_EQ(chosen_cases(all, {"scale-bits"}).size(), 1u);
  for (const Case& c : chosen_cases(all, {"6"})) EXPECT_EQ(c.group, 6);
  try {
    chosen_cases(all, {"scale-bit"});
    FAIL() << "an unknown case is taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("scale-bits"), std::string::npos) << error.what();
  }
}

TEST(StressOptions, RefuseUnknownPlugins) {
  EXPECT_THROW(parse_stress_options({"--integrators", "pathh"}), Error);
  EXPECT_THROW(parse_stress_options({"--samplers", "sobol,sobl"}), Error);
  EXPECT_THROW(parse_stress_options({"--time", "soon"}), Error);
  const auto o = parse_stress_options({"--integrators", "path", "--time", "3m", "--case", "2"});
  ASSERT_TRUE(o);
  EXPECT_EQ(o->runner.integrators, std::vector<std::string>{"path"});
  EXPECT_EQ(o->runner.seconds, 180.0);
}

TEST(StressCatalogue, HasDistinctCasesOfAllGroups) {
  std::set<std::string> names;
  std::set<int> groups;
  for (const Case& c : catalogue()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.points.empty()) << c.name;
    EXPECT_FALSE(c.about.empty()) << c.name;
    groups.insert(c.group);
  }
  for (int g = 1; g <= 11; ++g) EXPECT_TRUE(groups.contains(g)) << g;
}

// False alarm: 10^-6, of the runner's own statistics. Builds with sanitizers are too slow to decide
// by statistics: what they run must not fail.
TEST(StressRun, ExtremesPass) {
  add_faulty_plugins();
  if (test::reduced()) {
    const Cases few =
        extremes({"scale-bits", "radiance-bits", "slab-index", "slivers", "stacked-glass",
                  "refused-geometry", "fov", "ground", "faulty-material"});
    for (const Entry& e : run(few, {"path"}, {"sobol", "pssmlt"})) {
      EXPECT_NE(e.outcome.verdict, Verdict::fail) << told(few, e);
    }
    return;
  }
  const Cases cases =
      extremes({"scale-bits", "coordinates", "radiance-bits", "light-radius", "metal-furnace-0",
                "density-integral", "slab-index", "stacked-glass", "white-sphere-1", "extinction",
                "slivers", "refused-geometry", "ground", "fov", "constant", "no-large-steps",
                "faulty-material", "throwing-integrator"});
  for (const Entry& e : run(cases, {"path"}, {"sobol", "pssmlt"})) {
    EXPECT_TRUE(e.outcome.verdict == Verdict::pass || e.outcome.verdict == Verdict::cannot_see)
        << told(cases, e);
  }
}

TEST(StressRun, SaysWhoCannotSee) {
  const Cases cases = extremes({"white-sphere-2"});
  const std::vector<Entry> entries = run(cases, {"whitted"}, {"sobol"});
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].outcome.verdict, Verdict::cannot_see);
  EXPECT_NE(entries[0].outcome.reason.find("whitted sees"), std::string::npos);
}

// A picture that is 20 % too bright, one that is too dark at one side, one that is not twice as
// bright as it should be, one that should be refused, one that should be warned of.
TEST(StressRun, WrongPicturesFail) {
  Cases cases = extremes({"white-sphere-1", "light-radius", "scale-bits"});
  std::get<Means>(cases[2].points[0].oracle).values[0] *= 1.2;
  std::get<Means>(cases[1].points[0].oracle).values[3] *= .6;
  std::get<SameBits>(cases[0].points[0].oracle).factor = 2.0;
  cases.push_back(cases[0]);
  cases.back().points[0].oracle = Refused{"never"};
  cases.push_back(cases[0]);
  cases.back().points[0].oracle = SameBits{};
  cases.back().points[0].warnings = {"a warning that nothing gives"};
  const std::vector<Entry> entries = run(cases, {"path"}, {"sobol", "pssmlt"});
  for (const Entry& e : entries) EXPECT_EQ(e.outcome.verdict, Verdict::fail) << told(cases, e);
  EXPECT_EQ(exit_code(count(entries)), 1);
}

// What has to run does, the rest is told.
TEST(StressRun, ListsWhatDidNotRun) {
  const Cases cases = chosen_cases(catalogue(), {"scale-bits"});
  const std::vector<Entry> entries = run(cases, {"path"}, {"sobol", "independent"}, 0.0);
  const Totals t = count(entries);
  EXPECT_EQ(t.pass, 1u);
  EXPECT_EQ(t.not_run, entries.size() - 1);
  EXPECT_EQ(exit_code(t), 3);
  const std::string table = terminal_table(cases, entries);
  EXPECT_NE(table.find("not run: scale-bits"), std::string::npos) << table;
}

TEST(StressReport, HoldsTheDataAsText) {
  const Cases cases = extremes({"scale-bits"});
  Entry entry{.of_case = 0, .of_point = 0, .pair = {"path", "sobol"}, .outcome = {}};
  entry.outcome.verdict = Verdict::fail;
  entry.outcome.reason = "</script><b>";
  const nlohmann::json data = result_data(cases, {entry}, "pssmlt stress", 1.0);
  EXPECT_EQ(data["totals"]["fail"], 1);
  EXPECT_EQ(data["cases"][0]["points"][0]["runs"][0]["verdict"], "FAIL");
  const std::string page = report_page(data);
  EXPECT_NE(page.find("scale-bits"), std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(page.find("@PSSMLT"), std::string::npos);
  EXPECT_EQ(page.find("src=\""), std::string::npos) << "something is not in the page";
}

}  // namespace
}  // namespace pssmlt::stress
