// Lines and tables of made-up runs.
#include "app/compare/terminal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "app/metrics/metrics.h"
#include "core/base/log.h"

namespace pssmlt::compare {
namespace {

TEST(Sparkline, IsLogarithmic) {
  EXPECT_EQ(sparkline({1.0, 10.0, 100.0}, 1.0, 100.0, 8), "▁▅█");
  EXPECT_EQ(sparkline({0.0, 1.0, -1.0}, 1.0, 1.0, 8), "·▁·");
  EXPECT_EQ(sparkline({100.0, 1.0, 1.0}, 1.0, 100.0, 2), "▁▁") << "the last ones";
  EXPECT_EQ(sparkline({}, 1.0, 2.0, 8), "");
}

RunRecord record(double scale) {
  RunRecord r;
  r.nominal = {1.0, 2.0, 4.0};
  for (const double t : {0.5, 1.0, 2.0, 4.0}) {
    RunPoint p;
    p.seconds = p.nominal = t;
    p.samples = 1000.0 * t;
    p.rays = 5000.0 * t;
    p.metrics.assign(metrics().size(), scale / t);
    r.points.push_back(p);
  }
  r.statistics = {{"rejected", {{"total", 2}}},
                  {"memory", {{"peak_bytes", 1e6}, {"film_bytes", 1e5}}}};
  return r;
}

CompareOptions options() {
  CompareOptions o;
  o.techniques = parse_technique_list("path,bdpt");
  o.techniques[1].name = "odd, \"name\"";
  o.seconds = 4.0;
  o.runs = 2;
  return o;
}

SceneReport scene(const std::string& name, double factor) {
  SceneReport s;
  s.name = name;
  s.reference.source = "file";
  s.reference.floor.assign(metrics().size(), 0.01);
  s.parameters = {nlohmann::json::object(), nlohmann::json::object()};
  s.integrators = {"path", "bdpt"};
  s.samplers = {"sobol", "sobol"};
  s.runs = {{record(1.0), record(factor)}, {record(2.0), record(2.0 * factor)}};
  s.result = analyse(s.runs, s.reference.floor, 4.0);
  return s;
}

TEST(RunLines, OneATechnique) {
  const CompareOptions o = options();
  const RunRecord one = record(1.0), none;
  const std::string name = "room";
  const RunView view{.scene = &name,
                     .run = 1,
                     .runs = 4,
                     .seconds = 8.0,
                     .techniques = &o.techniques,
                     .records = {&one, &none},
                     .elapsed = {4.0, 0.0}};
  const auto lines = run_lines(view);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "room: run 2 of 4, 25 %");
  EXPECT_NE(lines[1].find("█▆▃▁"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("no picture yet"), std::string::npos);
}

// What a terminal gets from a program that shows a run and then logs a line.
std::string on_a_terminal() {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return "";
  const int slave = open(ptsname(master), O_RDWR | O_NOCTTY);
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(slave, STDERR_FILENO);
    const CompareOptions o = options();
    const RunRecord one = record(1.0);
    const std::string name = "room";
    RunDisplay display(true);
    display.show({.scene = &name,
                  .run = 0,
                  .runs = 1,
                  .seconds = 8.0,
                  .techniques = &o.techniques,
                  .records = {&one, &one},
                  .elapsed = {4.0, 4.0}});
    log_info("a line");
    _exit(0);
  }
  waitpid(pid, nullptr, 0);
  std::string text(4096, '\0');  // the terminal holds as much until it is read
  const ssize_t size = read(master, text.data(), text.size());
  text.resize(static_cast<size_t>(std::max<ssize_t>(size, 0)));
  close(slave);
  close(master);
  return text;
}

TEST(RunDisplay, IsClearedBeforeTheLogSpeaks) {
  const std::string text = on_a_terminal();
  if (text.empty()) GTEST_SKIP() << "there are no terminals here";
  const size_t run = text.find("room: run 1"), cleared = text.find("\033[3A\033[J");
  EXPECT_LT(run, cleared) << text;
  EXPECT_LT(cleared, text.find("a line")) << text;
  EXPECT_NE(text.find("a line"), std::string::npos) << text;
}

TEST(Tables, SayWhatWasFound) {
  const std::string text = scene_table(options(), scene("room", 0.25));
  EXPECT_NE(text.find("room"), std::string::npos);
  EXPECT_NE(text.find("4 [4, 4]"), std::string::npos) << text;  // speed-up, in both runs alike
  EXPECT_NE(text.find("as independent samples"), std::string::npos) << text;
  EXPECT_EQ(text.find("more than a quarter"), std::string::npos) << text;
  SceneReport near = scene("room", 0.01);
  EXPECT_NE(scene_table(options(), near).find("more than a quarter"), std::string::npos);
  near.reference.agreement.emplace();
  near.reference.agreement->biased = true;
  near.reference.agreement->text = "a and b do not agree";
  EXPECT_NE(scene_table(options(), near).find("BIAS: a and b"), std::string::npos);
}

// Speed-ups 2 and 8: geometric mean 4.
TEST(Tables, SuiteHasAGeometricMean) {
  const std::vector<SceneReport> scenes = {scene("one", 0.5), scene("two", 0.125)};
  EXPECT_NEAR(*suite_mean(scenes, 1, 0).value, 4.0, 1e-9);
  EXPECT_NE(suite_table(options(), scenes).find("geometric mean"), std::string::npos);
  EXPECT_EQ(suite_table(options(), {scenes[0]}), "");
  EXPECT_FALSE(suite_mean({scenes[0]}, 1, 0).value);
  EXPECT_TRUE(suite_json(options(), {scenes[0]}).is_null());
  EXPECT_NEAR(suite_json(options(), scenes)["mse"]["odd, \"name\""]["geometric_mean"].get<double>(),
              4.0, 1e-9);
}

TEST(CurvesCsv, QuotesNamesAndLeavesUnknownFieldsEmpty) {
  const std::string text = curves_csv(options(), {scene("room", 1.0)});
  EXPECT_NE(text.find("room,path,0,0,0.5,0.5,500,2500,2,"), std::string::npos) << text;
  EXPECT_NE(text.find("room,\"odd, \"\"name\"\"\",1,0,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0,,,,,0.01"), std::string::npos) << text;  // bias 0, the rest unknown
}

TEST(ReportJson, SaysWhyItIsPartial) {
  const auto whole = report_json(options(), {scene("room", 1.0)}, "");
  EXPECT_EQ(whole["partial"], false);
  EXPECT_EQ(whole["scenes"][0]["techniques"][0]["non_finite"], 4.0);
  EXPECT_EQ(whole["scenes"][0]["techniques"][0]["rates"]["samples_per_second"], 1000.0);
  const auto cut = report_json(options(), {}, "interrupted");
  EXPECT_EQ(cut["partial"], true);
  EXPECT_EQ(cut["why_partial"], "interrupted");
  EXPECT_TRUE(cut["scenes"].empty());
}

// What --resume reads is what was written.
TEST(RunRecord, SurvivesTheFile) {
  RunRecord r = record(1.0);
  r.seed = 18446744073709551615ull;
  r.points[1].mean_bias_error = 0.25;
  r.points[1].estimate_known = true;
  r.points[1].estimate = 0.1;
  r.images = {{1.0, "id", true}};
  const auto json = record_to_json(r);
  EXPECT_EQ(record_to_json(record_from_json(nlohmann::json::parse(json.dump()))), json);
  EXPECT_EQ(record_from_json(json).seed, r.seed);
}

}  // namespace
}  // namespace pssmlt::compare
