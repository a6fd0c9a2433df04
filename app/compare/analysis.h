// From the runs of a scene to what the report says about each technique. Formulas: docs/compare.md.
#pragma once

#include <string>
#include <vector>

#include "app/compare/run_record.h"
#include "app/compare/slope.h"

namespace pssmlt::compare {

// What is known about a technique by one metric.
struct MetricResult {
  Curve curve;
  Slope slope;
  Interval at_end;          // error at the end
  bool near_floor = false;  // at the end
  Interval speed_up;        // error of the first technique over this one's, run by run
  Number efficiency;        // 1 / (error * seconds) at the end
  std::vector<TimeTo> time_to;
};

struct TechniqueResult {
  std::vector<MetricResult> metrics;  // in the order of metrics()
  Interval calibration;               // estimated over true relMSE
};

struct SceneResult {
  Number end;  // when the errors "at the end" are compared [s]; nullopt: no common time
  std::vector<TechniqueResult> techniques;
};

// runs: [run][technique], all of them with points to compare; seconds: the budget.
SceneResult analyse(const std::vector<std::vector<RunRecord>>& runs,
                    const std::vector<Number>& floor, double seconds);

// The runs of one technique.
std::vector<RunRecord> runs_of(const std::vector<std::vector<RunRecord>>& runs, size_t technique);

// Errors of the 1-2-5 series that lie between the largest and the smallest of the curves, largest
// first; none below floor / floor_share.
std::vector<double> error_levels(const std::vector<const Curve*>& curves, const Number& floor);

// Estimated over true relMSE, which is the measured one less the floor, at the last point of each
// run that has an estimate and is not near the floor; geometric mean over runs.
Interval calibration(const std::vector<RunRecord>& runs, const Number& floor, size_t relmse);

}  // namespace pssmlt::compare
