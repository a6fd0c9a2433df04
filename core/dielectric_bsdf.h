// Glass: a smooth interface or GGX lobes of reflection and refraction (core/rough_interface.h).
#pragma once

#include "core/bsdf.h"
#include "core/microfacet.h"

namespace pssmlt {

// In `storage`. eta: index of the inside over that of the outside. Without contrast a facet's
// normal can't be told from the directions, and the ray goes on as through a smooth interface.
const Bsdf* make_dielectric_bsdf(float eta, const Ggx& ggx, BsdfStorage& storage);

}  // namespace pssmlt
