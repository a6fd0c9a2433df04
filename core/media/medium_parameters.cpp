#include "core/media/medium_parameters.h"

#include "core/media/presets.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

void check_coefficients(Parameters& p, std::string_view name, const Rgb& value) {
  if (!is_valid(value)) {
    p.fail(name, "\"" + std::string(name) + "\" must not be negative");
  }
}

}  // namespace

float read_anisotropy(Parameters& p) {
  const float g = p.number("g", 0.f, "",
                           "mean cosine of scattering (Henyey and Greenstein 1941): 0 in all "
                           "directions alike, positive forward, negative back; in (-1, 1)");
  if (!(std::abs(g) < 1.f)) p.fail("g", "\"g\" must lie between -1 and 1");
  return g;
}

Rgb read_emitted_radiance(Parameters& p) {
  const Rgb radiance = p.rgb("Le", Rgb(0.f), SpectrumUse::Illuminant, "W/(m^2 sr)",
                             "radiance of the medium where it is opaque and only absorbs");
  const float scale = p.number("Lescale", 1.f, "", "factor of the emission");
  if (scale < 0.f) p.fail("Lescale", "\"Lescale\" must not be negative");
  return radiance * scale;
}

ScatteringParameters::ScatteringParameters(Parameters& p, bool presets,
                                           const Rgb& absorption_fallback,
                                           const Rgb& scattering_fallback) {
  Rgb a = absorption_fallback, s = scattering_fallback;
  if (presets) {
    const std::string name =
        p.text("preset", "",
               "a measured medium, as \"Wholemilk\", \"Skin1\" or \"Coke\", instead of "
               "sigma_a and sigma_s; its unit is 1/mm, so that a scene in metres needs scale 1000");
    const auto found = scattering_preset(name);
    if (!name.empty() && !found) {
      p.fail("preset", "no measured medium is named \"" + name + "\"" +
                           suggestion(name, scattering_preset_names()));
    }
    if (found) a = found->absorption, s = found->scattering;
  }
  absorption = p.rgb("sigma_a", a, SpectrumUse::Unbounded, "1/m", "absorption coefficient");
  scattering = p.rgb("sigma_s", s, SpectrumUse::Unbounded, "1/m", "scattering coefficient");
  const float scale = p.number("scale", 1.f, "", "factor of both coefficients");
  g = read_anisotropy(p);
  if (p.describing()) return;
  if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
  check_coefficients(p, "sigma_a", absorption);
  check_coefficients(p, "sigma_s", scattering);
  absorption *= scale;
  scattering *= scale;
}

}  // namespace pssmlt
