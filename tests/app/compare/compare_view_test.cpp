// `pssmlt compare --live` as users run it: the page, the data and pictures it shows, the stop
// button. Nothing depends on how fast the machine is: tests wait for what comes in the end.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/compare/text.h"
#include "tests/app/compare/small_room.h"
#include "tests/app/live/raw_http.h"

namespace pssmlt::compare {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

class CompareLive : public testing::Test {
 protected:
  CompareLive() {
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    write_file(folder_ / "room.txt", test::small_room);
  }
  ~CompareLive() override {
    unsetenv("XDG_CACHE_HOME");
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  void start(std::vector<std::string> more) {
    std::vector<std::string> all = {PSSMLT_BINARY,  "compare",   folder_ / "room.txt",
                                    "--techniques", "path,bdpt", "--reference-time",
                                    "50ms",         "--threads", "2",
                                    "-o",           report()};
    all.insert(all.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& a : all) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string out = folder_ / "out", err = folder_ / "err";
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
  std::string said() const { return fs::exists(folder_ / "err") ? read_file(folder_ / "err") : ""; }
  std::string report() const { return folder_ / "report"; }
  // What f() gives once it gives anything.
  template <typename F>
  static auto wait_for(const F& f) {
    auto found = f();
    for (int i = 0; i < patience / 20 && !found; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      found = f();
    }
    return found;
  }
  // The port that the command prints; 0: none.
  int port() const {
    return wait_for([this] {
      const std::string mark = "http://127.0.0.1:", text = said();
      const size_t at = text.find(mark);
      const bool whole = at != std::string::npos && text.find("/\n", at) != std::string::npos;
      return whole ? std::stoi(text.substr(at + mark.size())) : 0;
    });
  }
  static std::string get(int port, const std::string& target) {
    return ask(port, request(port, "GET " + target));
  }
  static std::optional<json> data(int port) {
    const std::string reply = get(port, "/data.json");
    return status_of(reply) == 200 ? std::optional(json::parse(body_of(reply))) : std::nullopt;
  }

  test::Folder folder_;
  pid_t pid_ = -1;
};

// Data in which all techniques have a picture.
bool has_pictures(const json& data) {
  if (data["scenes"].empty()) return false;
  for (const json& t : data["scenes"][0]["techniques"]) {
    if (t["images"].empty()) return false;
  }
  return true;
}

TEST_F(CompareLive, ShowsTheReportSoFarAndStops) {
  start({"--live", "--time", "10h", "--runs", "2"});
  const int at = port();
  ASSERT_NE(at, 0) << said();
  const std::string page = get(at, "/");
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'; script-src 'self'; style-src "
                      "'self'; connect-src 'self'"),
            std::string::npos);
  for (const char* file : {"/live.js", "/live.css", "/core.js", "/main.js", "/chart.min.js"}) {
    EXPECT_NE(page.find("\"" + std::string(file).substr(1) + "\""), std::string::npos) << file;
    EXPECT_EQ(status_of(get(at, file)), 200) << file;
  }
  auto events = std::make_unique<RawClient>(at);
  events->send_text(request(at, "GET /events"));
  EXPECT_NE(events->read_until("\"state\":\"running\"").find("event: hello"), std::string::npos);
  const auto shown = wait_for([at] {
    std::optional<json> d = data(at);
    return d && has_pictures(*d) ? d : std::nullopt;
  });
  ASSERT_TRUE(shown);
  EXPECT_TRUE((*shown)["partial"]);
  const json& scene = (*shown)["scenes"][0];
  EXPECT_FALSE(scene["techniques"][0]["runs"][0].contains("statistics"));
  const std::vector<std::string> ids = {scene["reference"]["image"],
                                        scene["techniques"][1]["images"][0]["image"]};
  for (const std::string& id : ids) {
    const std::string name = "/images/" + id + ".js", reply = get(at, name);
    EXPECT_NE(reply.find("Content-Type: text/javascript"), std::string::npos) << id;
    EXPECT_EQ(body_of(reply), read_file(report() + name)) << id;
  }
  // Files of the report that no data name.
  for (const char* other :
       {"/images/", "/images/../data.json", "/images/room-path.exr", "/images/scene0-reference",
        "/images/scene9-reference.js", "/runs/state.json", "/curves.csv", "/index.html"}) {
    EXPECT_EQ(status_of(get(at, other)), 404) << other;
  }
  EXPECT_EQ(status_of(ask(at, request(at, "POST /stop", origin_line(at)))), 403);
  EXPECT_EQ(status_of(ask(at, stop_request(at, token_of(at)))), 202);
  EXPECT_NE(events->read_until("\"final\":true").find("\"exit_code\":130"), std::string::npos);
  const std::optional<json> last = data(at);
  ASSERT_TRUE(last);
  EXPECT_NE((*last)["why_partial"].get<std::string>().find("interrupted"), std::string::npos);
  EXPECT_FALSE(events->timed_out());
  events.reset();  // as a page does that has all
  EXPECT_EQ(wait(), 130) << said();
  EXPECT_TRUE(json::parse(read_file(report() + "/data.json"))["partial"]);
}

// What a page gets to see during the second run: the first one's curves, and the second so far.
TEST_F(CompareLive, LaterRunsAreShownBesideTheCurves) {
  start({"--live", "--time", "100ms", "--runs", "10000"});
  const int at = port();
  ASSERT_NE(at, 0) << said();
  auto events = std::make_unique<RawClient>(at);
  events->send_text(request(at, "GET /events"));
  const auto shown = wait_for([at] {
    std::optional<json> d = data(at);
    const bool running = d && !(*d)["scenes"].empty() &&
                         (*d)["scenes"][0]["techniques"][0].contains("running") &&
                         !(*d)["scenes"][0]["techniques"][0]["running"].empty();
    return running ? d : std::nullopt;
  });
  ASSERT_TRUE(shown);
  const json& technique = (*shown)["scenes"][0]["techniques"][0];
  EXPECT_GE(technique["runs"].size(), 1u);
  EXPECT_GT(technique["running"][0]["metrics"]["relmse"].get<double>(), 0.0);
  EXPECT_FALSE(technique["curve"]["seconds"].empty());
  kill(pid_, SIGINT);
  EXPECT_NE(events->read_until("\"final\":true").find("\"exit_code\":130"), std::string::npos);
  events.reset();
  EXPECT_EQ(wait(), 130) << said();
  const json written = json::parse(read_file(report() + "/data.json"));
  EXPECT_FALSE(written["scenes"][0]["techniques"][0].contains("running"));
}

TEST_F(CompareLive, EndsByItselfWhenNobodyWatches) {
  EXPECT_EQ(run({"--live", "--time", "100ms", "--runs", "1"}), 0) << said();
  EXPECT_NE(said().find("live: http://127.0.0.1:"), std::string::npos);
  EXPECT_FALSE(json::parse(read_file(report() + "/data.json"))["partial"]);
}

TEST_F(CompareLive, WrongUseIsRefusedBeforeAnythingIsWritten) {
  EXPECT_EQ(run({"--port", "8080"}), 2) << "without --live";
  EXPECT_EQ(run({"--live", "--live-address", "0.0.0.0"}), 2);
  EXPECT_NE(said().find("--live-public"), std::string::npos);
  EXPECT_FALSE(fs::exists(report()));
}

}  // namespace
}  // namespace pssmlt::compare
