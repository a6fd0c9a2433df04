// The command as users run it: exit codes, signals, checkpoints that survive kill -9.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/image/image_file.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Command : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("pssmlt-command-" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
    scene_ = std::string(PSSMLT_SOURCE_DIR) + "/scenes/cornell-box.txt";
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  // Starts the command; output goes to files of the folder.
  pid_t start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), PSSMLT_BINARY);
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string out = in("stdout"), err = in("stderr");
    const pid_t pid = fork();
    if (pid != 0) return pid;
    const int mode = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(open(out.c_str(), mode, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), mode, 0600), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  // The exit code, 1000 + the signal if one ended the process.
  static int wait_for(pid_t pid) {
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  int run(const std::vector<std::string>& arguments) const { return wait_for(start(arguments)); }
  std::string error() const { return bytes_of(folder_ / "stderr"); }
  std::string output() const { return bytes_of(folder_ / "stdout"); }
  bool says(const std::string& text) const { return error().find(text) != std::string::npos; }

  fs::path folder_;
  std::string scene_;
};

TEST_F(Command, RendersAndDescribes) {
  ASSERT_EQ(run({scene_, "--size", "20x20", "--spp", "16", "-o", in("a.pfm"), "-o", in("b.pfm"),
                 "--json", in("s.json")}),
            0)
      << error();
  EXPECT_EQ(bytes_of(in("a.pfm")), bytes_of(in("b.pfm")));
  const nlohmann::json s = nlohmann::json::parse(bytes_of(in("s.json")));
  EXPECT_EQ(s["samples"].get<double>(), 16.0 * 400.0);
  EXPECT_TRUE(s["error"]["known"].get<bool>());
  for (const char* key : {"seconds", "rays", "rejected", "memory", "left_out", "layers"}) {
    EXPECT_TRUE(s.contains(key)) << key;
  }
  for (const char* text : {"scene load", "acceleration structure", "bootstrap", "write", "rays/s",
                           "error estimate", "rejected samples", "peak memory", "left out"}) {
    EXPECT_TRUE(says(text)) << text;
  }
}

// With five bootstrap samples nothing is known about b: no number stands for the error anywhere.
TEST_F(Command, FewBootstrapSamplesLeaveTheErrorUnknown) {
  ASSERT_EQ(run({scene_, "--size", "32x32", "--spp", "64", "--sampler", "pssmlt", "--set",
                 "sampler.bootstrapsamples=5", "--aux", "variance,error", "-o", in("a.exr"),
                 "--json", in("s.json")}),
            0)
      << error();
  const nlohmann::json s = nlohmann::json::parse(bytes_of(in("s.json")));
  EXPECT_FALSE(s["error"]["known"].get<bool>());
  EXPECT_FALSE(s["error"].contains("relative_mse"));
  EXPECT_FALSE(s["error"].contains("mean"));
  EXPECT_FALSE(s["warnings"].empty());
  EXPECT_TRUE(says("error estimate: unknown (only "));
  EXPECT_TRUE(
      says("of 5 bootstrap samples found light, fewer than 10: brightness and error are unknown"));
  EXPECT_TRUE(says("variance and error are left out"));
  const ImageFile file = read_image_file(in("a.exr"));
  std::string said;
  for (const auto& [key, value] : file.metadata) said += key == "pssmlt:error" ? value : "";
  EXPECT_EQ(said.find("unknown (only "), 0u) << said;
}

TEST_F(Command, QuietSaysNothing) {
  ASSERT_EQ(run({"render", scene_, "--size", "8x8", "--spp", "1", "--quiet", "-o", in("a.pfm")}),
            0);
  EXPECT_EQ(error(), "");
  EXPECT_EQ(output(), "");
}

TEST_F(Command, BadUsageIsCode2) {
  const std::vector<std::vector<std::string>> cases = {
      {},
      {"no-such-scene.txt"},
      {scene_, "--no-such-option"},
      {scene_, "--spp", "0"},
      {scene_, "--spp", "-3"},
      {scene_, "--time", "5 parsecs"},
      {scene_, "--time", "-5s"},
      {scene_, "--time", "nan"},
      {scene_, "--target-error", "0"},
      {scene_, "--threads", "0"},
      {scene_, "--size", "20"},
      {scene_, "--size", "0x10"},
      {scene_, "--crop", "1,2,3"},
      {scene_, "--scale", "0"},
      {scene_, "--aux", "albedo,colour", "-o", in("a.exr")},
      {scene_, "--aux", "albedo", "-o", in("a.png")},
      {scene_, "--set", "integrator.nosuch=1"},
      {scene_, "--integrator", "pathh"},
      {scene_, "-o", in("a.xyz")},
      {scene_, "-o", "/nonexistent/a.exr"},
      {scene_, "--checkpoint", "/nonexistent/c", "-o", in("a.pfm")},
      {scene_, "--json", "/nonexistent/c", "-o", in("a.pfm")},
      {scene_, "--quiet", "--verbose"},
      {scene_, "--pixel", "100000,0"},
      {scene_, "--replay", "nonsense"},
      {scene_, "--replay", "sobol:1:2"},
      {"plugins", "nosuchkind"},
      {"plugins", "integrator", "nosuch"},
      {"info", "no-such-scene.txt"},
      {"error", "no-such.exr", "no-such.exr"},
      {"error", "no-such.exr"},
      {"merge", "no-such.exr", "no-such.exr", "-o", in("a.pfm")},
      {"merge", "no-such.exr", "no-such.exr"}};
  for (const auto& arguments : cases) {
    std::string line;
    for (const std::string& a : arguments) line += a + " ";
    EXPECT_EQ(run(arguments), 2) << line << error();
    EXPECT_FALSE(error().empty()) << line;
  }
  EXPECT_FALSE(fs::exists(in("a.pfm")));
}

TEST_F(Command, BareTimeIsSecondsAndSaysSo) {
  ASSERT_EQ(run({scene_, "--size", "8x8", "--time", "0.1", "-o", in("a.pfm")}), 0) << error();
  EXPECT_TRUE(says("seconds"));
}

TEST_F(Command, OtherSubcommands) {
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_NE(output().find("Embree"), std::string::npos);
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_EQ(run({"render", "--help"}), 0);
  EXPECT_NE(output().find("--target-error"), std::string::npos);
  EXPECT_EQ(run({"info", scene_}), 0);
  EXPECT_NE(output().find("triangles"), std::string::npos);
  EXPECT_EQ(run({"plugins"}), 0);
  EXPECT_NE(output().find("pssmlt"), std::string::npos);
  EXPECT_EQ(run({"plugins", "sampler", "pssmlt"}), 0);
  EXPECT_NE(output().find("largestepprobability"), std::string::npos);
  EXPECT_EQ(run({"plugins", "--markdown"}), 0);
  EXPECT_NE(output().find("| parameter | type |"), std::string::npos);
}

TEST_F(Command, PixelAndReplay) {
  ASSERT_EQ(run({scene_, "--size", "20x20", "--pixel", "10,10", "--spp", "1"}), 0) << error();
  const std::string traced = output();
  const size_t at = traced.find("u:");
  ASSERT_NE(at, std::string::npos);
  const std::string key = traced.substr(at, traced.find('\n', at) - at);
  // Under its numbers alone the sample takes the whole window; it still gives the same numbers.
  ASSERT_EQ(run({scene_, "--size", "20x20", "--replay", key}), 0) << error();
  EXPECT_NE(output().find(key), std::string::npos);
  ASSERT_EQ(run({scene_, "--size", "20x20", "--integrator", "path", "--sampler", "pssmlt",
                 "--replay", key}),
            0);
}

TEST_F(Command, ChecksOutputsBeforeRendering) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::create_directory(folder_ / "locked");
  fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(run({scene_, "-o", in("locked/a.exr")}), 2);
}

TEST_F(Command, FilmGbufferWritesLayersWhereAFormatHoldsThem) {
  std::ofstream(in("ball.txt"))
      << "Film \"gbuffer\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string "
         "coordinatesystem\" \"world\" WorldBegin LightSource \"distant\" Translate 0 0 3 Shape "
         "\"sphere\"";
  ASSERT_EQ(run({in("ball.txt"), "--spp", "64", "-o", in("a.exr"), "-o", in("a.pfm")}), 0)
      << error();
  const ImageFile image = read_image_file(in("a.exr"));
  for (const char* layer : {"R", "albedo.R", "normal.Y", "variance.B"}) {
    EXPECT_GE(image.find(layer), 0) << layer;
  }
  EXPECT_EQ(read_image_file(in("a.pfm")).channels, 3);
}

TEST_F(Command, InterruptWritesWhatThereIs) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t pid = start({scene_, "--size", "16x16", "--spp", "1e9", "-o", in("a.pfm"),
                             "--checkpoint", in("c"), "--json", in("s.json")});
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    kill(pid, signal);
    ASSERT_EQ(wait_for(pid), 130) << error();
    // The written picture is that of a render of so many samples.
    const auto s = nlohmann::json::parse(bytes_of(in("s.json")));
    const int spp = s["layers"][0]["rounds"].get<int>();
    ASSERT_GT(spp, 0);
    EXPECT_GT(fs::file_size(in("c")), 1000u);
    fs::remove(in("c"));
  }
}

// Killed at random moments and resumed each time, then compared with an undisturbed render.
TEST_F(Command, KilledAndResumedGivesTheSameBits) {
  std::mt19937 random(11);
  for (const std::string sampler : {"sobol", "pssmlt"}) {
    std::vector<std::string> common = {scene_,         "--size", "24x17", "--sampler", sampler,
                                       "--integrator", "bdpt",   "--spp", "300",       "--quiet"};
    if (sampler == "pssmlt") {
      common.insert(common.end(), {"--set", "sampler.bootstrapsamples=2000"});
    }
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), common.begin(), common.end());
      return more;
    };
    const std::string checkpoint = in("c-" + sampler), output = in("a-" + sampler + ".pfm");
    const auto resumable =
        with({"-o", output, "--checkpoint", checkpoint, "--checkpoint-every", "30ms", "--resume"});
    for (int kills = 0; kills < 3; ++kills) {
      const pid_t pid = start(resumable);
      // The first run gets as far as a checkpoint, the others to wherever they get.
      for (int i = 0; i < 500 && !fs::exists(checkpoint); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
      const int delay = std::uniform_int_distribution<int>(0, 300)(random);
      std::this_thread::sleep_for(std::chrono::milliseconds(delay));
      kill(pid, SIGKILL);
      (void)wait_for(pid);
    }
    ASSERT_TRUE(fs::exists(checkpoint)) << error();
    // Another number of threads in the end: it may not matter either.
    ASSERT_EQ(run(with({"-o", output, "--checkpoint", checkpoint, "--resume", "--threads", "3",
                        "--json", in("s.json")})),
              0)
        << error();
    EXPECT_TRUE(nlohmann::json::parse(bytes_of(in("s.json")))["resumed"].get<bool>());
    ASSERT_EQ(run(with({"-o", in("b.pfm"), "--threads", "1"})), 0) << error();
    EXPECT_EQ(bytes_of(output), bytes_of(in("b.pfm"))) << sampler;
  }
}

TEST_F(Command, ResumeOfAnotherSceneIsRefused) {
  const std::vector<std::string> common = {scene_, "--size",    "8x8",          "--spp", "2",
                                           "-o",   in("a.pfm"), "--checkpoint", in("c")};
  ASSERT_EQ(run(common), 0) << error();
  auto other = common;
  other[0] = std::string(PSSMLT_SOURCE_DIR) + "/scenes/mis-plates.txt";
  other.push_back("--resume");
  EXPECT_EQ(run(other), 2);
  EXPECT_TRUE(says("another scene")) << error();
  auto more = common;
  more[4] = "6";
  more.push_back("--resume");
  EXPECT_EQ(run(more), 0) << error();
}

}  // namespace
}  // namespace pssmlt
