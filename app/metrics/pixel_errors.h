// Metrics whose value at a pixel is a function of that pixel's colours alone.
#pragma once

#include <vector>

#include "app/metrics/picture_pair.h"

namespace pssmlt {

// A value per pixel, the mean over the channels; NaN where the pixel does not count. The epsilons
// are multiples of the reference's mean luminance, so that relative metrics do not change with
// exposure. Where a denominator is 0 the value is 0 if the colours are equal and infinite if not.
using ErrorMap = std::vector<double>;

ErrorMap squared_errors(const PicturePair& pair);
ErrorMap relative_squared_errors(const PicturePair& pair);
// relative_squared_errors() with NaN at the pixels of largest value: floor(N / 1000) of the N that
// count, of equal ones those further up and left.
ErrorMap trimmed_relative_squared_errors(const PicturePair& pair);
ErrorMap symmetric_errors(const PicturePair& pair);

// Mean of what is not NaN, summed in the order of the pixels; NaN if there is nothing.
double mean_error(const ErrorMap& map);

// SMAPE's epsilon over the reference's mean luminance.
inline constexpr double smape_epsilon = 0.01;

}  // namespace pssmlt
