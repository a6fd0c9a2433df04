#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace pssmlt {
namespace {

constexpr double line_interval = 10.0;  // without a terminal [s]

std::string phase_text(const Progress& p) {
  if (p.phase == RenderPhase::prepare) return "preparing";
  return fmt::format("bootstrap, {}", format_duration(p.elapsed));
}

std::string text(const Progress& p) {
  if (p.phase != RenderPhase::render) return phase_text(p);
  std::string line =
      fmt::format("{:5.1f} %  {} elapsed", 100.0 * p.fraction, format_duration(p.elapsed));
  if (p.remaining >= 0.0) line += fmt::format(", {} left", format_duration(p.remaining));
  line += fmt::format("  {}{}/s", format_count(p.samples_per_second),
                      p.chains ? "mutations" : "samples");
  if (p.error != nullptr && p.error->known) {
    line += fmt::format("  relMSE {:.3g}", p.error->relative_mse);
  } else {
    line += "  error not known yet";
  }
  return line;
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool shown)
    : shown_(shown),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_(terminal_ ? 0.0 : line_interval) {}

void ProgressDisplay::show(const Progress& progress) {
  if (!shown_ || (!terminal_ && progress.elapsed < next_)) return;
  const std::string line = text(progress);
  if (terminal_) {
    std::fprintf(stderr, "\r%s\033[K", line.c_str());
    dirty_ = true;
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
    next_ = progress.elapsed + line_interval;
  }
  std::fflush(stderr);
}

void ProgressDisplay::clear() {
  if (dirty_) std::fputs("\r\033[K", stderr);
  dirty_ = false;
}

std::string format_duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} m {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} m", whole / 3600, whole % 3600 / 60);
}

std::string format_count(double count) {
  static constexpr std::pair<double, const char*> prefixes[] = {
      {1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
  for (const auto& [size, prefix] : prefixes) {
    if (count >= size) return fmt::format("{:.3g} {}", count / size, prefix);
  }
  return fmt::format("{:.3g} ", count);
}

}  // namespace pssmlt
