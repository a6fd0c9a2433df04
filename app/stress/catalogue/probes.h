// Cases that are no pictures: what the catalogue asks of single functions and of the program.
#pragma once

#include "app/stress/case.h"

namespace pssmlt::stress {

// The density of GGX metal and glass over the sphere against the share of draws that succeed, for
// several directions, in double.
Outcome integrate_density(double alpha);

}  // namespace pssmlt::stress
