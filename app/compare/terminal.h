// What `pssmlt compare` shows while it runs and at the end.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "app/compare/contest.h"
#include "app/compare/report_data.h"

namespace pssmlt::compare {

// Unicode blocks for values over time, on a logarithmic scale from `low` to `high`; the last
// `width` values, a dot for one that has no logarithm.
std::string sparkline(const std::vector<double>& values, double low, double high, size_t width);

// One line a technique with its error's sparkline so far. On a terminal the lines are overwritten,
// and cleared when the log has something to say; elsewhere they are printed every 10 seconds. One
// at a time.
class RunDisplay {
 public:
  explicit RunDisplay(bool shown);
  ~RunDisplay();
  RunDisplay(const RunDisplay&) = delete;
  RunDisplay& operator=(const RunDisplay&) = delete;
  void show(const RunView& view);
  void show_reference(const std::string& scene, double seconds, double of);
  void clear();

 private:
  bool due();
  void print(const std::vector<std::string>& lines);
  void erase();  // with the lock
  bool shown_, terminal_;
  double next_ = 0.0;     // when lines are due [s of a steady clock]
  std::mutex mutex_;      // of what is on the screen: other threads log, too
  size_t on_screen_ = 0;  // lines to overwrite
};

// The lines of one moment, the first about the run.
std::vector<std::string> run_lines(const RunView& view);

// Tables of a scene: errors at the end, slopes, speed-ups, rates, calibration; times to errors.
std::string scene_table(const CompareOptions& options, const SceneReport& scene);
// Speed-ups by scene, with their geometric means; "" for one scene.
std::string suite_table(const CompareOptions& options, const std::vector<SceneReport>& scenes);

}  // namespace pssmlt::compare
