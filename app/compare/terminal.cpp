#include "app/compare/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "app/metrics/metrics.h"
#include "app/progress.h"
#include "core/base/log.h"

namespace pssmlt::compare {
namespace {

constexpr std::array<const char*, 8> blocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr size_t spark_width = 24;
constexpr double terminal_interval = 0.2, line_interval = 10.0;  // [s]

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool drawable(double v) { return v > 0.0 && std::isfinite(v); }

}  // namespace

std::string sparkline(const std::vector<double>& values, double low, double high, size_t width) {
  std::string text;
  const size_t begin = values.size() > width ? values.size() - width : 0;
  for (size_t i = begin; i < values.size(); ++i) {
    if (!drawable(values[i])) {
      text += "·";
      continue;
    }
    const double range = std::log(high) - std::log(low);
    const double t = range > 0.0 ? (std::log(values[i]) - std::log(low)) / range : 0.0;
    const double step = std::floor(t * static_cast<double>(blocks.size()));
    text += blocks[static_cast<size_t>(std::clamp(step, 0.0, 7.0))];
  }
  return text;
}

std::vector<std::string> run_lines(const RunView& view) {
  const size_t metric = metric_index("relmse");
  double low = infinity, high = 0.0, done = 0.0;
  size_t name_width = 0;
  for (size_t t = 0; t < view.records.size(); ++t) {
    for (const RunPoint& p : view.records[t]->points) {
      if (!drawable(p.metrics[metric])) continue;
      low = std::min(low, p.metrics[metric]);
      high = std::max(high, p.metrics[metric]);
    }
    done += std::min(view.elapsed[t], view.seconds);
    name_width = std::max(name_width, (*view.techniques)[t].name.size());
  }
  const double all = view.seconds * static_cast<double>(view.records.size());
  std::vector<std::string> lines = {fmt::format("{}: run {} of {}, {:.0f} %", *view.scene,
                                                view.run + 1, view.runs, 100.0 * done / all)};
  for (size_t t = 0; t < view.records.size(); ++t) {
    std::vector<double> errors;
    for (const RunPoint& p : view.records[t]->points) errors.push_back(p.metrics[metric]);
    const std::string spark = sparkline(errors, low, high, spark_width);
    const size_t shown = std::min(errors.size(), spark_width);
    lines.push_back(fmt::format(
        "  {:<{}}  {}{}  {}", (*view.techniques)[t].name, name_width, spark,
        std::string(spark_width - shown, ' '),
        errors.empty() ? fmt::format("no picture yet after {}", format_duration(view.elapsed[t]))
                       : fmt::format("{} {:.3g} at {}", metrics()[metric].name, errors.back(),
                                     format_duration(view.records[t]->points.back().seconds))));
  }
  return lines;
}

RunDisplay::RunDisplay(bool shown)
    : shown_(shown),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_(now() + (terminal_ ? 0.0 : line_interval)) {
  print_log_by([this](const std::function<void()>& print_line) {
    const std::lock_guard lock(mutex_);
    erase();
    print_line();
  });
}

RunDisplay::~RunDisplay() {
  print_log_by({});
  clear();
}

bool RunDisplay::due() {
  if (!shown_ || now() < next_) return false;
  next_ = now() + (terminal_ ? terminal_interval : line_interval);
  return true;
}

void RunDisplay::show(const RunView& view) {
  if (due()) print(run_lines(view));
}

void RunDisplay::show_reference(const std::string& scene, double seconds, double of) {
  if (!due()) return;
  print({fmt::format("{}: reference, {} of {}", scene, format_duration(seconds),
                     format_duration(of))});
}

void RunDisplay::print(const std::vector<std::string>& lines) {
  const std::lock_guard lock(mutex_);
  erase();
  for (const std::string& line : lines) std::fprintf(stderr, "%s\n", line.c_str());
  if (terminal_) on_screen_ = lines.size();
  std::fflush(stderr);
}

void RunDisplay::clear() {
  const std::lock_guard lock(mutex_);
  erase();
}

void RunDisplay::erase() {
  if (on_screen_ > 0) std::fprintf(stderr, "\033[%zuA\033[J", on_screen_);
  on_screen_ = 0;
}

}  // namespace pssmlt::compare
