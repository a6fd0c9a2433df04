// pssmlt stress: extreme scenes whose pictures are known, with all techniques.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "app/compare/text.h"
#include "app/signals.h"
#include "app/stress/report_page.h"
#include "app/stress/stress_options.h"
#include "app/stress/table.h"
#include "app/stress/technique.h"
#include "core/base/log.h"

namespace pssmlt {
namespace {

using namespace stress;
namespace fs = std::filesystem;

constexpr const char* stopping =
    "\ninterrupted: finishing the run, then writing; again to leave at once without writing\n";

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print_list(const Cases& cases) {
  for (const Case& c : cases) {
    std::fputs(fmt::format("{:>2}  {:<22} {}\n", c.group, c.name, c.about).c_str(), stdout);
  }
}

// One line that is overwritten; nothing where standard error is no terminal.
void show_progress(const std::string& what, size_t done, size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fputs(fmt::format("\r\033[K{} of {}: {}", done, all, what).c_str(), stderr);
  std::fflush(stderr);
}

// Found now, not after hours.
void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder + "\": " + error.message());
  compare::write_file((fs::path(folder) / ".probe").string(), "");
  fs::remove(fs::path(folder) / ".probe", error);
}

}  // namespace

int run_stress(const Arguments& arguments) {
  std::optional<StressOptions> options = parse_stress_options(arguments);
  if (!options) return 0;
  StressOptions& o = *options;
  if (o.list) return print_list(o.cases), 0;
  for (const std::string& note : o.notes) log_info(note);
  make_folder(o.output);
  add_faulty_plugins();
  catch_signals(stopping);
  o.runner.program = fs::read_symlink("/proc/self/exe").string();
  o.runner.stop = [] { return stop_requested().load(); };
  if (!o.quiet) o.runner.progress = show_progress;
  const double start = now();
  const std::vector<Entry> entries = Runner(o.cases, o.runner).run();
  if (!o.quiet && isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
  const nlohmann::json data = result_data(o.cases, entries, o.command, now() - start);
  compare::write_file((fs::path(o.output) / "results.json").string(), data.dump(1) + "\n");
  compare::write_file((fs::path(o.output) / "index.html").string(), stress::report_page(data));
  if (!o.quiet) std::fputs(terminal_table(o.cases, entries).c_str(), stdout);
  log_info("wrote " + (fs::path(o.output) / "index.html").string());
  return stop_requested() ? exit_interrupted : exit_code(count(entries));
}

}  // namespace pssmlt
