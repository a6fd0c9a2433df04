// How much each of several renders of one picture counts in their average. The renders are
// independent and each has the true picture as its mean, so that any weights that sum to 1 and are
// not chosen pixel by pixel keep that; the right ones make the error small.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/render_record.h"

namespace pssmlt {

// Renders of one technique count by their numbers of samples: their variances are inverse to them,
// exactly and without looking at the picture. Techniques among each other count by the inverse of
// their estimated relMSE, one number for the whole image. Sums to 1. Throws Error if techniques
// differ and an estimate is missing or 0.
std::vector<double> merge_weights(std::span<const RenderRecord> records);

// What the merged image says about itself. `independent`: no two records share numbers; without
// it nothing is known about the error. The samples of one technique are those that would make the
// same variance, 1 / sum(w^2 / n), which is their sum for weights by samples.
RenderRecord merged_record(std::span<const RenderRecord> records, std::span<const double> weights,
                           bool independent);

// Sum of w^2 e with its interval, from the records' estimates; nullopt if one is missing.
std::optional<RelativeError> merged_error(std::span<const RenderRecord> records,
                                          std::span<const double> weights);

// True if two of the records hold renders of the same technique from the same seed.
bool share_numbers(const RenderRecord& a, const RenderRecord& b);
// True if two of the records hold renders from the same seed, of whatever technique.
bool share_seeds(const RenderRecord& a, const RenderRecord& b);

}  // namespace pssmlt
