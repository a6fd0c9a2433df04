// One scene's runs: techniques interleaved, points of their error curves, pictures of the first
// run.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/compare_options.h"
#include "app/compare/reference.h"
#include "app/compare/run_record.h"
#include "app/report/report.h"

namespace pssmlt::compare {

// A run while it goes on, for whoever shows it.
struct RunView {
  const std::string* scene = nullptr;
  int run = 0, runs = 1;
  double seconds = 0.0;  // budget of each technique [s]
  const std::vector<Technique>* techniques = nullptr;
  std::vector<const RunRecord*> records;  // by technique
  std::vector<double> elapsed;            // by technique [s]
};

class Contest {
 public:
  // All must outlive it. `index`: of the scene, for image names.
  Contest(const CompareOptions& options, int index, const LoadedScene& scene,
          const Reference& reference, ReportWriter& writer);
  // Runs all techniques; `first`: the first run's records, whose times of snapshots this one takes
  // over (null: this is the first, whose pictures are kept). Sets `cut` if stopped before the end:
  // the records then hold what there is.
  std::vector<RunRecord> run(int run, const std::vector<RunRecord>* first,
                             const std::atomic<bool>& stop,
                             const std::function<void(const RunView&)>& watch, bool& cut);

 private:
  struct Entrant;
  void after_round(Entrant& entrant);
  void take_point(Entrant& entrant, double nominal, bool last);
  void end_early(Entrant& entrant);
  void keep_image(Entrant& entrant, const RenderResult& result, bool last);
  std::vector<std::unique_ptr<Entrant>> enter(int run, const std::vector<RunRecord>* first);

  const CompareOptions& options_;
  int index_;
  const LoadedScene& scene_;
  const Reference& reference_;
  ReportWriter& writer_;
};

// Name of a technique's final picture of the first run, an ordinary file in the report's images/.
std::string final_image_name(const std::string& scene, const std::string& technique);

}  // namespace pssmlt::compare
