// Do two techniques make the same picture? A test by blocks of pixels, from the spread of their
// groups of samples.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/compare/interval.h"
#include "core/render/develop.h"

namespace pssmlt::compare {

// A difference is called bias when the test gives chance alone less than this probability. The
// approximation behind it is least exact where one error that all blocks share outweighs the rest:
// false alarms are then up to ten times as frequent, 1e-4.
inline constexpr double bias_probability = 1e-5;
// Fewer groups than this say too little.
inline constexpr int least_test_groups = 8;

struct Agreement {
  int blocks = 0;         // that were compared
  double chi_square = 0;  // their sum of squared deviations, scaled to `degrees`
  double degrees = 0.0;   // effective: blocks are not independent of each other
  Number p_value;         // unknown: too few groups
  bool biased = false;
  std::string text;  // one sentence
};
nlohmann::json to_json(const Agreement& agreement);

// Both of the same picture by independent random numbers. In every block the groups' differences
// give Student's t, turned into a normal deviation z of the same tail; the sum of z^2 has as many
// degrees of freedom as blocks if these are independent. Chains and b make them dependent: the sum
// is scaled to the number of degrees that the groups' correlations leave (Satterthwaite, with the
// estimate of tr R^2 that is unbiased for normal numbers).
Agreement test_agreement(const GroupBlocks& a, const GroupBlocks& b, const std::string& name_a,
                         const std::string& name_b);

}  // namespace pssmlt::compare
