// The two ends of a way beneath a surface that diffuses light. Where light enters, the boundary
// reflects as a dielectric does; what it does not reflect goes on beneath (BsdfSample::beneath).
// Where light leaves again, directions are forgotten: it leaves as (1 - F) |cos|.
//
// Both ends of the separable function are alike, (1 - F), so that it does not matter which one a
// path meets first. That an end is entered has the probability 1 - F of the smooth boundary.
#pragma once

#include "core/bsdf.h"
#include "core/color/fresnel.h"
#include "core/diffusion/diffusion_profile.h"
#include "core/microfacet.h"

namespace pssmlt {

const Bsdf* make_entry_bsdf(const DiffusionProfile& profile, const Ggx& ggx, BsdfStorage& storage);
// side: of the shading normal on which light leaves, 1 or -1. Its `wo`, beneath the surface, is not
// used; pdf(wi, beneath) is the probability of entering from wi.
const Bsdf* make_exit_bsdf(const DiffusionProfile& profile, float side, BsdfStorage& storage);
inline constexpr vec3 beneath{0.f, 0.f, 0.f};

}  // namespace pssmlt
