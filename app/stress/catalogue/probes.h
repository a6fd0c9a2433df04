// Cases that are no pictures: what the catalogue asks of single functions and of the program.
#pragma once

#include "app/stress/case.h"

namespace pssmlt::stress {

// The density of GGX metal and glass over the sphere against the share of draws that succeed, for
// several directions, in double.
Outcome integrate_density(double alpha);

// A lamp of this radius in a picture 2 wide and 2 high, of which 8192 bootstrap samples find few.
Outcome few_contributing(const ProbeContext& context, double radius);

}  // namespace pssmlt::stress
