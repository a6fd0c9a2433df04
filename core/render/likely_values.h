// What the true picture may be near a pixel, for the denominators of relative errors. A pixel's own
// value will not do: a firefly would be divided by itself, and the estimate of a picture full of
// them would be small where the error is large.
#pragma once

#include "core/image/image.h"

namespace pssmlt {

// Means over square windows around each pixel that grow until they are known well enough, the
// pixel itself alone where its halves agree. A window that contradicts a smaller one (their
// confidence intervals do not meet, an edge) is not taken: intersection of confidence intervals,
// Katkovnik 1999, "A new method for varying adaptive bandwidth selection". Never below
// the darker half's value, which only what is really bright can raise. All images have three
// channels and one size; the halves are independent estimates of the picture. Result in the
// picture's order and units.
Image likely_values(const Image& picture, const Image& half0, const Image& half1);

}  // namespace pssmlt
