// pssmlt compare as users run it, on a room of 32 x 24 pixels. Nothing here depends on how fast the
// machine is: however few rounds fit into a budget, every technique has one.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "app/compare/compare_options.h"
#include "app/compare/text.h"
#include "app/metrics/metrics.h"
#include "tests/app/compare/small_room.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

class Compare : public testing::Test {
 protected:
  Compare() {
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    write_file(scene_, test::small_room);
  }
  ~Compare() override { unsetenv("XDG_CACHE_HOME"); }
  // Exit code of the command; its output is in files of the folder.
  int run(const std::string& arguments) {
    const std::string command = std::string(PSSMLT_BINARY) + " compare " + arguments + " >" +
                                folder_ / "out" + " 2>" + folder_ / "err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  pid_t start(const std::string& arguments) const {
    const pid_t pid = fork();
    if (pid != 0) return pid;
    const std::string command = "exec " + std::string(PSSMLT_BINARY) + " compare " + arguments +
                                " >" + folder_ / "out" + " 2>" + folder_ / "err";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  static int exit_code(pid_t pid) {
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  // Until there is a file whose name begins so, or the process has ended.
  static void wait_for_file(pid_t pid, const fs::path& begin) {
    const std::string name = begin.filename().string();
    siginfo_t info{};
    while (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0) {
      std::error_code none;
      for (const auto& entry : fs::directory_iterator(begin.parent_path(), none)) {
        const std::string found = entry.path().filename().string();
        if (found.starts_with(name) && entry.path().extension() != ".part") return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  std::string output() const { return read_file(folder_ / "out"); }
  std::string errors() const { return read_file(folder_ / "err"); }
  std::string report() const { return folder_ / "report"; }
  json data() const { return json::parse(read_file(report() + "/data.json")); }
  // A short comparison with a reference made for no longer than it must.
  std::string quick(const std::string& more = "", const std::string& time = "300ms",
                    const std::string& reference_time = "100ms") const {
    return scene_ + " --techniques path,mlt --time " + time + " --reference-time " +
           reference_time + " --threads 2 -o " + report() +
           " --technique 'few=integrator:path;sampler:pssmlt,bootstrapsamples=2000' " + more;
  }

  test::Folder folder_;
  std::string scene_ = folder_ / "room.txt";
};

TEST_F(Compare, LeavesAReport) {
  ASSERT_EQ(run(quick("--runs 2 --seed 5")), 0) << errors();
  const json d = data();
  EXPECT_EQ(d["format"], 1);
  EXPECT_FALSE(d["partial"].get<bool>());
  EXPECT_EQ(d["settings"]["runs"], 2);
  EXPECT_EQ(d["techniques"].size(), 3u);
  EXPECT_EQ(d["techniques"][1]["integrator"], "bdpt");
  EXPECT_EQ(d["techniques"][1]["sampler"], "pssmlt");
  EXPECT_TRUE(d["suite"].is_null());
  EXPECT_NE(d["command"].get<std::string>().find("--seed 5"), std::string::npos);
  const json& scene = d["scenes"][0];
  EXPECT_EQ(scene["width"], 32);
  EXPECT_EQ(scene["reference"]["source"], "made");
  EXPECT_TRUE(fs::exists(report() + "/images"));
  EXPECT_TRUE(fs::exists(report() + "/images/room-path.exr"));
  for (const json& t : scene["techniques"]) {
    ASSERT_EQ(t["runs"].size(), 2u);
    EXPECT_EQ(t["runs"][1]["seed"], 6);
    EXPECT_TRUE(t["parameters"]["integrator"].contains("maxdepth"));
    EXPECT_FALSE(t["images"].empty());
    EXPECT_EQ(t["images"].back()["precision"], "exact");
    for (const Metric& m : metrics()) {
      const std::string id(m.id);
      EXPECT_TRUE(t["curve"].contains(id) && t["slope"].contains(id) && t["at_end"].contains(id) &&
                  t["speed_up"].contains(id) && t["time_to"].contains(id) &&
                  t["efficiency"].contains(id));
      EXPECT_EQ(t["curve"][id]["mean"].size(), t["curve"]["seconds"].size());
    }
    for (const json& run : t["runs"]) {
      double last = 0.0;
      for (const json& p : run["points"]) {
        EXPECT_GT(p["seconds"].get<double>(), last);
        EXPECT_GE(p["seconds"].get<double>(), p["nominal"].get<double>());
        EXPECT_GT(p["metrics"]["relmse"].get<double>(), 0.0);
        last = p["seconds"];
      }
      EXPECT_GE(last, 0.3) << "whole rounds past the budget";
    }
  }
  for (const char* text : {"technique", "speed-up", "path", "mlt", "few"}) {
    EXPECT_NE(output().find(text), std::string::npos) << text;
  }
}

TEST_F(Compare, CsvHasEveryPoint) {
  ASSERT_EQ(run(quick("--runs 1")), 0) << errors();
  std::istringstream lines(read_file(report() + "/curves.csv"));
  std::string header, line;
  std::getline(lines, header);
  EXPECT_TRUE(
      header.starts_with("scene,technique,run,seed,nominal_seconds,seconds,samples,rays,mse"));
  size_t count = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(header, ',')) << line;
    ++count;
  }
  size_t points = 0;
  const json d = data();
  for (const json& t : d["scenes"][0]["techniques"]) points += t["runs"][0]["points"].size();
  EXPECT_EQ(count, points);
  // One run: no bands, which the table says.
  EXPECT_TRUE(d["scenes"][0]["techniques"][0]["at_end"]["mse"]["low"].is_null());
  EXPECT_NE(output().find("no intervals"), std::string::npos);
}

// The picture of a run is that of `pssmlt render` with its seed and its number of samples.
TEST_F(Compare, PicturesAreThoseOfRender) {
  ASSERT_EQ(run(quick("--runs 1 --seed 3")), 0) << errors();
  const json d = data();
  const json& scene = d["scenes"][0];
  const auto check = [&](size_t t, const std::string& options, const std::string& name) {
    const json& layer = scene["techniques"][t]["runs"][0]["statistics"]["layers"][0];
    // Just below, so that rounding asks for no more.
    const double spp = layer["samples_per_pixel"].get<double>() * (1.0 - 1e-9);
    const std::string command = std::string(PSSMLT_BINARY) + " render " + scene_ +
                                " --seed 3 --quiet --threads 1 " + options + " --spp " +
                                json(spp).dump() + " -o " + folder_ / "r.exr";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read_image(folder_ / "r.exr", "").data,
              read_image(report() + "/images/" + name, "").data)
        << options;
  };
  check(0, "--integrator path --sampler sobol", "room-path.exr");
  check(2, "--integrator path --sampler pssmlt --set sampler.bootstrapsamples=2000",
        "room-few.exr");
}

TEST_F(Compare, ResumeKeepsFinishedRuns) {
  ASSERT_EQ(run(quick("--runs 1")), 0) << errors();
  const json before = data();
  ASSERT_EQ(run(quick("--runs 2 --resume")), 0) << errors();
  const json after = data();
  EXPECT_EQ(after["scenes"][0]["techniques"][1]["runs"].size(), 2u);
  for (size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(before["scenes"][0]["techniques"][t]["runs"][0],
              after["scenes"][0]["techniques"][t]["runs"][0]);
    EXPECT_EQ(before["scenes"][0]["techniques"][t]["images"],
              after["scenes"][0]["techniques"][t]["images"]);
  }
  // A run that was not written to its end is repeated.
  std::ofstream(report() + "/runs/scene0-run1.json", std::ios::trunc) << "{\"reference\": 1";
  ASSERT_EQ(run(quick("--runs 2 --resume")), 0) << errors();
  EXPECT_EQ(data()["scenes"][0]["techniques"][0]["runs"][0],
            after["scenes"][0]["techniques"][0]["runs"][0]);
}

TEST_F(Compare, ResumeRefusesOtherSettings) {
  ASSERT_EQ(run(quick("--runs 1")), 0) << errors();
  const std::string untouched = read_file(report() + "/data.json");
  for (const char* other : {"--resume --seed 1", "--resume --snapshots 20", "--resume --size 16x12",
                            "--resume --set integrator.maxdepth=2", "--resume --slice 1s"}) {
    EXPECT_EQ(run(quick(other)), 2) << other;
    EXPECT_NE(errors().find("cannot resume"), std::string::npos) << errors();
  }
  EXPECT_EQ(run(quick("--resume --reference-techniques light,path")), 2) << "another reference";
  EXPECT_EQ(read_file(report() + "/data.json"), untouched);
}

// Signals come when a file is there; that it will be is only a matter of time.
TEST_F(Compare, CtrlCLeavesAPartialReport) {
  const pid_t pid = start(quick("--runs 2 --snapshots 20", "10h"));
  wait_for_file(pid, report() + "/images/scene0-technique2-0");
  kill(pid, SIGINT);
  EXPECT_EQ(exit_code(pid), 130) << errors();
  const json d = data();
  EXPECT_TRUE(d["partial"].get<bool>());
  EXPECT_NE(d["why_partial"].get<std::string>().find("interrupted"), std::string::npos);
  const json& scene = d["scenes"][0];
  EXPECT_LT(scene["end_seconds"].get<double>(), 3600.0);
  for (const json& t : scene["techniques"]) {
    ASSERT_EQ(t["runs"].size(), 1u);
    EXPECT_FALSE(t["runs"][0]["points"].empty());
    EXPECT_EQ(t["images"].back()["precision"], "exact");
  }
  EXPECT_FALSE(fs::exists(report() + "/runs/scene0-run0.json")) << "it will be repeated";
}

TEST_F(Compare, CtrlCDuringTheReference) {
  const pid_t pid = start(quick("", "300ms", "10h"));
  wait_for_file(pid, report() + "/runs/state");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // either side of it is fine
  kill(pid, SIGINT);
  EXPECT_EQ(exit_code(pid), 130) << errors();
  EXPECT_TRUE(data()["partial"].get<bool>());
  EXPECT_TRUE(data()["scenes"].empty());
}

TEST_F(Compare, KillLosesTheRunInProgress) {
  const pid_t pid = start(quick("--runs 10000"));
  wait_for_file(pid, report() + "/runs/scene0-run1");
  kill(pid, SIGKILL);
  EXPECT_EQ(exit_code(pid), 1000 + SIGKILL);
  const json d = data();  // whole, whatever was being written
  EXPECT_TRUE(d["partial"].get<bool>());
  const json first = d["scenes"][0]["techniques"][0]["runs"][0];
  ASSERT_EQ(run(quick("--runs 2 --resume")), 0) << errors();
  EXPECT_EQ(data()["scenes"][0]["techniques"][0]["runs"][0], first);
  EXPECT_FALSE(data()["partial"].get<bool>());
}

TEST_F(Compare, SuitesHaveAMean) {
  write_file(folder_ / "suite.txt", "room.txt name=one\nroom.txt size=16x12 name=two\n");
  ASSERT_EQ(
      run("--suite " + folder_ / "suite.txt" +
          " --techniques path,bdpt --time 200ms --runs 2 --reference-time 50ms -o " + report()),
      0)
      << errors();
  const json d = data();
  ASSERT_EQ(d["scenes"].size(), 2u);
  EXPECT_EQ(d["scenes"][1]["width"], 16);
  EXPECT_EQ(d["suite"]["mse"]["path"]["geometric_mean"], 1.0);
  EXPECT_TRUE(d["suite"]["mse"].contains("bdpt"));
  EXPECT_NE(output().find("geometric mean"), std::string::npos);
}

TEST_F(Compare, BlindTechniquesAndOnePixel) {
  // Whitted sees no indirect light, this one no light at all.
  ASSERT_EQ(run(scene_ + " --techniques path,whitted --technique " +
                "'black=integrator:path,maxdepth=0;sampler:pssmlt,bootstrapsamples=100' --set "
                "camera.fov=5 " +
                "--time 100ms --runs 1 --reference-time 50ms -o " + report()),
            0)
      << errors();
  const json d = data();
  const json& black = d["scenes"][0]["techniques"][2];
  EXPECT_NEAR(black["runs"][0]["points"].back()["mean_bias"].get<double>(), -1.0, 1e-9);
  ASSERT_EQ(run(scene_ + " --size 1x1 --time 50ms --runs 2 --reference-time 20ms -o " + report()),
            0)
      << errors();
  EXPECT_EQ(data()["scenes"][0]["width"], 1);
}

// Nine bootstrap samples say nothing about the error: no number stands for it, a warning says why.
TEST_F(Compare, ErrorOfFewBootstrapSamplesIsUnknown) {
  ASSERT_EQ(run(scene_ + " --techniques path --technique " +
                "'few=integrator:path;sampler:pssmlt,bootstrapsamples=9' --time 150ms --runs 1 "
                "--reference-time 100ms -o " +
                report()),
            0)
      << errors();
  const json d = data();
  const json& few = d["scenes"][0]["techniques"][1];
  for (const json& p : few["runs"][0]["points"]) {
    EXPECT_EQ(p["estimate"]["known"], false);
    EXPECT_TRUE(p["estimate"]["relmse"].is_null());
  }
  EXPECT_TRUE(few["calibration"]["ratio"].is_null());
  ASSERT_FALSE(few["warnings"].empty());
  const auto warning = few["warnings"][0].get<std::string>();
  EXPECT_NE(warning.find("of 9 bootstrap samples found"), std::string::npos) << warning;
  EXPECT_NE(errors().find("few: " + warning), std::string::npos) << errors();
}

// One round is longer than the budget: it is finished, nothing is extrapolated.
TEST_F(Compare, TimeShorterThanARound) {
  ASSERT_EQ(run(scene_ + " --techniques path,mlt --time 1ms --runs 2 --reference-time 50ms -o " +
                report()),
            0)
      << errors();
  const json d = data();
  const json& mlt = d["scenes"][0]["techniques"][1];
  EXPECT_EQ(mlt["runs"][0]["points"].size(), 1u);
  EXPECT_TRUE(mlt["at_end"]["mse"]["mean"].is_null());
  EXPECT_TRUE(mlt["speed_up"]["mse"]["value"].is_null());
  EXPECT_NE(output().find("longer than --time"), std::string::npos) << output();
}

TEST_F(Compare, WrongInputIsRefusedBeforeAnythingIsWritten) {
  write_file(folder_ / "bad.txt", std::string(test::small_room) + "Shape \"sphre\"\n");
  Image small(4, 4, 3);
  write_image(folder_ / "small.exr", small, {}, {});
  write_file(folder_ / "file", "");
  for (const std::string& arguments :
       std::vector<std::string>{"",
                                "none.txt",
                                folder_ / "bad.txt",
                                scene_ + " " + folder_ / "bad.txt",
                                scene_ + " --techniques path,bdtp",
                                scene_ + " --techniques path,path",
                                scene_ + " --technique x=integrator:path,maxdeth=3",
                                scene_ + " --technique x=integrator:path,maxdepth=deep",
                                scene_ + " --reference " + folder_ / "small.exr",
                                scene_ + " --reference none.exr",
                                scene_ + " " + scene_ + " --reference " + folder_ / "small.exr",
                                scene_ + " --reference-techniques path",
                                scene_ + " --reference-techniques path,path",
                                scene_ + " --time 0s",
                                scene_ + " --time soon",
                                scene_ + " --runs 0",
                                scene_ + " --snapshots 3",
                                scene_ + " --slice -1s",
                                scene_ + " --size 0x4",
                                scene_ + " --suite none.txt",
                                scene_ + " --techniques-file none.txt",
                                scene_ + " --quiet --verbose"}) {
    EXPECT_EQ(run(arguments + " -o " + report()), 2) << arguments << errors();
    EXPECT_FALSE(errors().empty());
    EXPECT_FALSE(fs::exists(report())) << arguments;
  }
  EXPECT_EQ(run(scene_ + " --time 1h -o " + folder_ / "file"), 1) << "no folder";
  EXPECT_EQ(run(scene_ + " --time 1h -o /proc/report"), 1) << "not writable";
}

TEST(CompareOptions, Defaults) {
  const auto o = parse_compare_options({"scenes/cornell-box.txt"});
  ASSERT_TRUE(o);
  ASSERT_EQ(o->techniques.size(), 3u);
  EXPECT_EQ(o->techniques[2].name, "mlt");
  EXPECT_EQ(o->seconds, 60.0);
  EXPECT_EQ(o->runs, 4);
  EXPECT_EQ(o->snapshots, 12);
  EXPECT_EQ(o->slice, 0.25);
  EXPECT_EQ(o->reference_seconds, reference_factor * 60.0);
  EXPECT_EQ(o->output, "report");
}

TEST(CompareOptions, CommandCanBePastedIntoAShell) {
  const auto o = parse_compare_options({"a b.txt", "--technique", "it's=integrator:path"});
  EXPECT_EQ(o->command, "pssmlt compare 'a b.txt' --technique 'it'\\''s=integrator:path'");
}

}  // namespace
}  // namespace pssmlt::compare
