// `pssmlt render --live` and `--display` as users run them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/live/live.h"
#include "core/image/image.h"
#include "tests/app/live/fake_viewer.h"
#include "tests/app/live/raw_http.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class RenderLive : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("pssmlt-live-" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    fs::remove_all(folder_);
  }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string said() const { return bytes_of(folder_ / "stderr"); }

  void start(std::vector<std::string> more) {
    std::vector<std::string> arguments = {
        PSSMLT_BINARY, "render", std::string(PSSMLT_SOURCE_DIR) + "/scenes/cornell-box.txt",
        "--sampler",   "pssmlt", "--integrator",
        "path"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string out = in("stdout"), err = in("stderr");
    pid_ = fork();
    if (pid_ != 0) return;
    const int mode = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(open(out.c_str(), mode, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), mode, 0600), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  int run(const std::vector<std::string>& more) {
    start(more);
    return wait();
  }
  // The port that the command prints.
  int port() const {
    const std::string mark = "http://127.0.0.1:";
    for (int i = 0; i < patience / 20; ++i) {
      const std::string text = said();
      const size_t at = text.find(mark);
      if (at != std::string::npos && text.find("/\n", at) != std::string::npos) {
        return std::stoi(text.substr(at + mark.size()));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ADD_FAILURE() << "no address was printed: " << said();
    return 0;
  }
  std::string maps() const { return bytes_of("/proc/" + std::to_string(pid_) + "/maps"); }

  fs::path folder_;
  pid_t pid_ = -1;
};

TEST_F(RenderLive, StopEndsAsAnInterruptDoes) {
  start({"--size", "32x32", "--spp", "1e9", "--live", "-o", in("a.pfm"), "--checkpoint", in("c"),
         "--json", in("s.json")});
  const int at = port();
  RawClient page(at);
  page.send_text(request(at, "GET /events"));
  // The first picture is there when a round is complete.
  const std::string events = page.read_until("event: image");
  ASSERT_FALSE(page.timed_out());
  for (const char* word : {"\"state\":", "\"scene\":", "\"elapsed\":", "\"samples_per_second\":",
                           "\"remaining\":", "\"fraction\":"}) {
    EXPECT_NE(events.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.read_until("acceptance_rate").find("acceptance_rate"), std::string::npos);
  const std::string picture = body_of(ask(at, request(at, "GET /image/picture")));
  EXPECT_EQ(picture.size(), 16u + 6 * 32 * 32);
  EXPECT_EQ(picture.substr(0, 4), "PSH1");
  EXPECT_NE(maps().find("/live_server.so"), std::string::npos);
  const std::string page_text = body_of(ask(at, request(at, "GET /")));
  EXPECT_NE(page_text.find("live.js"), std::string::npos);
  EXPECT_EQ(status_of(ask(at, request(at, "GET /live.js"))), 200);
  EXPECT_EQ(status_of(ask(at, request(at, "GET /live.css"))), 200);
  EXPECT_EQ(status_of(ask(at, stop_request(at, token_of(at)))), 202);
  page.read_until("\"final\":true");
  EXPECT_FALSE(page.timed_out());
  ASSERT_EQ(wait(), 130) << said();
  const auto s = nlohmann::json::parse(bytes_of(in("s.json")));
  EXPECT_EQ(s["stopped_by"], "interrupted");
  EXPECT_GT(fs::file_size(in("c")), 1000u);
  EXPECT_GT(fs::file_size(in("a.pfm")), 32u * 32 * 12);
}

// The same bits with a page, a viewer and somebody who looks on as without.
TEST_F(RenderLive, WatchingChangesNothing) {
  const std::vector<std::string> work = {"--size", "48x48", "--spp", "60", "--seed", "3"};
  auto with = work;
  FakeViewer viewer;
  for (const std::string& more :
       {std::string("--live"), std::string("--display"), viewer.address(), std::string("-o"),
        in("with.pfm"), std::string("--threads"), std::string("2")}) {
    with.push_back(more);
  }
  start(with);
  const int at = port();
  std::string events;
  {
    RawClient page(at);
    page.send_text(request(at, "GET /events"));
    events = page.read_until("\"final\":true");
  }
  ASSERT_EQ(wait(), 0) << said();
  auto without = work;
  without.insert(without.end(), {"-o", in("without.pfm"), "--threads", "1"});
  ASSERT_EQ(run(without), 0) << said();
  EXPECT_EQ(bytes_of(in("with.pfm")), bytes_of(in("without.pfm")));
  EXPECT_NE(events.find("event: image"), std::string::npos);
  EXPECT_NE(events.find("with.pfm"), std::string::npos) << "the page says what was written";
  // The viewer has the picture that was written, every float of it.
  const std::vector<std::string> names = viewer.names();
  ASSERT_EQ(names.size(), 1u);
  EXPECT_NE(names[0].find("cornell-box"), std::string::npos);
  const Image shown = viewer.picture(names[0], 48 * 48 * 3);
  EXPECT_EQ(shown.data, read_image(in("with.pfm"), "").data);
}

// Every control of the page, in Chromium where there is one.
TEST_F(RenderLive, ThePageInABrowser) {
  start({"--size", "160x120", "--spp", "1e9", "--live", "-o", in("a.pfm")});
  const std::string command =
      "timeout 100 " + std::string(PSSMLT_SOURCE_DIR) +
      "/tests/app/live/page_in_browser.py http://127.0.0.1:" + std::to_string(port()) + "/ >" +
      in("browser") + " 2>&1";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  if (code == 77) GTEST_SKIP() << bytes_of(in("browser"));
  ASSERT_EQ(code, 0) << bytes_of(in("browser"));
  EXPECT_EQ(wait(), 130) << said();
}

TEST_F(RenderLive, ClientsThatStallDoNotDelayTheEnd) {
  start({"--size", "16x16", "--spp", "1e9", "--live", "-o", in("a.pfm")});
  const int at = port();
  RawClient stream(at, 4096), half(at), silent(at);
  half.send_text("GET / HT");
  stream.send_text(request(at, "GET /events"));
  stream.read_until("event: image");
  kill(pid_, SIGINT);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(wait(), 130) << said();
  // A second is given to pages to take the end; the server's timeouts are 5 s and more.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
}

TEST_F(RenderLive, BadUsageIsCode2) {
  std::atomic<bool> stop{false};
  const LiveServer other({}, stop);
  const std::string taken = std::to_string(other.port());
  const std::vector<std::vector<std::string>> cases = {
      {"--port", "8080"},
      {"--live-address", "127.0.0.1"},
      {"--live-public"},
      {"--live", "--port", "0"},
      {"--live", "--port", "70000"},
      {"--live", "--port", "http"},
      {"--live", "--port", taken},
      {"--live", "--live-address", "0.0.0.0"},
      {"--live", "--live-address", "::"},
      {"--live", "--live-address", "example.org"},
      {"--live", "--live-address", "127.0.0.1:80"},
      {"--live", "--pixel", "1,1"},
      {"--display"},
      {"--display", "host:port"},
      {"--display", "[::1"},
      {"--display", "localhost", "--pixel", "1,1"}};
  for (std::vector<std::string> arguments : cases) {
    std::string line;
    for (const std::string& a : arguments) line += a + " ";
    arguments.insert(arguments.end(), {"--size", "8x8", "--spp", "1", "-o", in("a.pfm")});
    EXPECT_EQ(run(arguments), 2) << line << said();
    EXPECT_FALSE(said().empty()) << line;
  }
  EXPECT_FALSE(fs::exists(in("a.pfm")));
}

TEST_F(RenderLive, AMissingViewerIsAWarning) {
  ASSERT_EQ(run({"--size", "16x16", "--spp", "40", "--display", "127.0.0.1:1", "-o", in("a.pfm")}),
            0);
  const std::string text = said();
  EXPECT_NE(text.find("warning: no viewer at 127.0.0.1:1"), std::string::npos) << text;
  EXPECT_EQ(text.find("no viewer"), text.rfind("no viewer")) << text;
}

}  // namespace
}  // namespace pssmlt
