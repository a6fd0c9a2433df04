#include "core/layered/layer_parameters.h"

#include "core/base/log.h"

namespace pssmlt {

LayerMedium read_layer_medium(Parameters& p, float eta) {
  constexpr int most = WalkNumbers::capacity - 2;
  LayerMedium m;
  m.eta = eta;
  m.thickness = p.number("thickness", 0.01f, "", "of the coat, in mean free paths of its medium");
  m.albedo = p.rgb("albedo", Rgb(0.f), SpectrumUse::Albedo, "",
                   "of the coat's medium: what it scatters of the light that it stops");
  m.g = p.number("g", 0.f, "", "mean cosine of scattering in the coat's medium, in (-1, 1)");
  m.events = p.integer("maxdepth", 10, "",
                       "reflections and scattering events between the layers; at most 20");
  const int samples = p.integer("nsamples", 1, "",
                                "walks a hit; without effect: every hit draws one, and samples of "
                                "the pixel average them");
  if (!(m.thickness >= 0.f)) p.fail("thickness", "\"thickness\" must not be negative");
  if (!(std::abs(m.g) < 1.f)) p.fail("g", "\"g\" must lie between -1 and 1");
  if (m.events < 1) p.fail("maxdepth", "\"maxdepth\" must be positive");
  if (samples < 1) p.fail("nsamples", "\"nsamples\" must be positive");
  if (p.describing()) return m;
  m.albedo = glm::clamp(m.albedo, Rgb(0.f), Rgb(1.f));
  if (m.events > most) {
    log_info(p.owner() + ": walks between layers end after " + std::to_string(most) + " events");
    m.events = most;
  }
  return m;
}

}  // namespace pssmlt
