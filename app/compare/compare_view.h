// The page that follows a comparison: the report so far, what is being done, a stop button. All is
// done on the comparison's thread between two turns, when no technique's clock runs; without a page
// that is open the report is not made.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/compare/contest.h"
#include "app/compare/report_data.h"
#include "app/live/live.h"

namespace pssmlt::compare {

class CompareView {
 public:
  // Starts the server if the options ask for it and prints its address. Both must outlive it;
  // `stop` becomes true when the page's stop button is pressed. Throws Error (an address that
  // cannot be had).
  CompareView(const CompareOptions& options, const std::vector<SceneReport>& scenes,
              std::atomic<bool>& stop);
  // `state` as docs/live.md has it; `index` of the scene.
  void show_state(const std::string& state, int index);
  void show_reference(double seconds, double of);
  void show_run(const RunView& run);
  // The scenes are not what they were.
  void results_changed();
  // The last word; waits shortly for pages to take it and the pictures that they have not shown.
  void finish(int exit_code, const std::string& why_partial);

 private:
  bool due();
  void publish(const RunView* run);
  void publish_data(const RunView* run);
  void publish_image(const std::string& id);
  nlohmann::json report(const RunView* run) const;

  const CompareOptions& options_;
  const std::vector<SceneReport>& scenes_;
  std::unique_ptr<LiveServer> server_;
  nlohmann::json status_;
  std::string why_partial_ = "the comparison is still running";
  int data_version_ = 0;          // of /data.json
  bool stale_ = true;             // /data.json is older than the results
  size_t points_ = 0;             // of the run's curves, when it was looked at last
  double next_ = 0.0;             // when a status is due [s of a steady clock]
  std::set<std::string> images_;  // published
};

}  // namespace pssmlt::compare
