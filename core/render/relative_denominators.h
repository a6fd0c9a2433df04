// What squared errors are divided by to be relative, where the truth is not known. A pixel's own
// square will not do: a firefly would be divided by itself, and the estimate of a picture full of
// them would be small where the error is large.
#pragma once

#include <vector>

#include "core/image/image.h"

namespace pssmlt {

// Estimates of t^2 + epsilon, t the true picture, so that the mean of variance / result is about
// the mean of variance / (t^2 + epsilon). Three cases, blended by the relative variance r of the
// mean of the pixel's halves:
//  - halves agree (r <= 0.02): the pixel's own square.
//  - noise: the square of the mean of the smallest window that is known to 10 %, unless it
//    contradicts a smaller one (their confidence intervals do not meet: an edge; Katkovnik 1999, "A
//    new method for varying adaptive bandwidth selection"). At least the darker half's.
//  - a spike in one half (r near 1): it might as well have met any pixel nearby, so the mean of
//    1 / (t^2 + epsilon) over those, t being what they are without spikes plus the spikes' share
//    of the light, from a window that holds enough of them. At most what the darker halves around
//    it prove: at the edge of a lamp a spike is no accident.
// All images have three channels and one size; the halves are independent estimates of the
// picture. Result in the picture's order [picture's unit squared]; 0 where nothing is known.
std::vector<double> relative_denominators(const Image& picture, const Image& half0,
                                          const Image& half1, double epsilon);

}  // namespace pssmlt
