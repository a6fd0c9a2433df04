// Smoke and fire: a substance whose density is given on a regular grid and interpolated in between,
// with an emission that is the same everywhere or follows a grid of temperatures. Source: pbrt-v4's
// uniformgrid for the parameters. Free flight is exact (core/media/lattice.h); its cost grows with
// the number of cells that a ray crosses. Densities of arbitrary size are better off in nanovdb.
#include "core/media/density_medium.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

std::vector<float> read_values(Parameters& p, std::string_view name, const LatticeFrame& frame,
                               std::string_view doc) {
  std::vector<float> values = p.numbers(name, "", doc);
  if (!p.describing() && !values.empty()) check_lattice_values(p, name, frame, values);
  return values;
}

class UniformGrid final : public DensityMedium {
 public:
  static constexpr const char* summary = "density on a regular grid";

  explicit UniformGrid(Parameters& p) : DensityMedium(read(p)) {}

 private:
  static DensityParts read(Parameters& p) {
    const LatticeFrame frame = read_lattice_frame(p);
    DensityParts parts{ScatteringParameters(p, true, Rgb(1.f), Rgb(1.f)), nullptr, {}};
    std::vector<float> density =
        read_values(p, "density", frame, "densities, x fastest, then y, then z");
    parts.glow = read_glow(p, frame);
    if (p.describing()) return parts;
    if (density.empty()) p.fail("a uniformgrid medium needs \"density\"");
    parts.density = make_lattice(frame, std::move(density));
    return parts;
  }
  static Glow read_glow(Parameters& p, const LatticeFrame& frame) {
    Glow glow;
    std::vector<float> temperature =
        read_values(p, "temperature", frame, "temperatures [K], as many as densities");
    read_temperature_range(p, glow);
    glow.radiance =
        p.rgb("Le", Rgb(0.f), SpectrumUse::Illuminant, "W/(m^2 sr)",
              "radiance of the medium where it is opaque and only absorbs; not with temperatures");
    std::vector<float> factor =
        p.numbers("Lescale", "", "factor of the emission: one, or as many as densities; 1");
    if (p.describing()) return glow;
    if (factor.size() > 1) {
      check_lattice_values(p, "Lescale", frame, factor);
      glow.factor = make_lattice(frame, std::move(factor));
    } else if (factor.size() == 1) {
      glow.factor_constant = factor[0];
    }
    if (!(glow.factor_constant >= 0.f)) p.fail("Lescale", "\"Lescale\" must not be negative");
    if (temperature.empty()) return glow;
    if (!is_black(glow.radiance)) p.fail("Le", "\"Le\" and \"temperature\" exclude each other");
    glow.temperature = make_lattice(frame, std::move(temperature));
    return glow;
  }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Medium, "uniformgrid", pssmlt::UniformGrid)
