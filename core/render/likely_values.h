// What the true picture may be near a pixel, for the denominators of relative errors. A pixel's own
// value will not do: a firefly would be divided by itself, and the estimate of a picture full of
// them would be small where the error is large.
#pragma once

#include "core/image/image.h"

namespace pssmlt {

// Per channel: the picture's own value where the two halves agree. The less they do, the more it
// gives way: if it lies above the mean around it, to the larger of that mean and the smaller half
// (a firefly, unless both halves are bright), if it lies below, to half the way to that mean. The
// mean is over a window of 7 x 7 pixels, and of 31 x 31 where the small one knows little. All
// images have three channels and one size; the halves are independent estimates of the picture.
// Result in the picture's order and units.
Image likely_values(const Image& picture, const Image& half0, const Image& half1);

}  // namespace pssmlt
