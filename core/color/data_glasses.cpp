// Refractive indices of optical glasses from their Sellmeier coefficients,
//   n^2 = 1 + sum_i B_i L^2 / (L^2 - C_i),  L = wavelength in micrometres
// (Schott optical glass catalogue). They are sampled every 10 nm, where linear interpolation is off
// by less than 1e-4.
#include "core/color/named_data.h"

namespace pssmlt::named_data {
namespace {

struct Sellmeier {
  dvec3 b;
  dvec3 c;  // [um^2]
};

constexpr Sellmeier bk7 = {{1.03961212, 0.231792344, 1.01046945},
                           {0.00600069867, 0.0200179144, 103.560653}};
constexpr Sellmeier baf10 = {{1.5851495, 0.143559385, 1.08521269},
                             {0.00926681282, 0.0424489805, 105.613573}};
constexpr Sellmeier fk51a = {{0.971247817, 0.216901417, 0.904651666},
                             {0.00472301995, 0.0153575612, 168.68133}};
constexpr Sellmeier lasf9 = {{2.00029547, 0.298926886, 1.80691843},
                             {0.0121426017, 0.0538736236, 156.530829}};
constexpr Sellmeier sf5 = {{1.52481889, 0.187085527, 1.42729015},
                           {0.011254756, 0.0588995392, 129.141675}};
constexpr Sellmeier sf10 = {{1.62153902, 0.256287842, 1.64447552},
                            {0.0122241457, 0.0595736775, 147.468793}};
constexpr Sellmeier sf11 = {{1.73759695, 0.313747346, 1.89878101},
                            {0.013188707, 0.0623068142, 155.23629}};

Samples sampled(const Sellmeier& glass) {
  Samples samples;
  for (int lambda = 360; lambda <= 830; lambda += 10) {
    const double l2 = sqr(lambda * 1e-3);
    const dvec3 terms = glass.b * l2 / (dvec3(l2) - glass.c);
    samples.emplace_back(float(lambda), float(std::sqrt(1. + terms.x + terms.y + terms.z)));
  }
  return samples;
}

}  // namespace

std::vector<Entry> glasses() {
  return {{"glass-BK7", [] { return sampled(bk7); }},
          {"glass-BAF10", [] { return sampled(baf10); }},
          {"glass-FK51A", [] { return sampled(fk51a); }},
          {"glass-LASF9", [] { return sampled(lasf9); }},
          {"glass-F5", [] { return sampled(sf5); }},
          {"glass-SF5", [] { return sampled(sf5); }},
          {"glass-F10", [] { return sampled(sf10); }},
          {"glass-SF10", [] { return sampled(sf10); }},
          {"glass-F11", [] { return sampled(sf11); }},
          {"glass-SF11", [] { return sampled(sf11); }}};
}

}  // namespace pssmlt::named_data
