#include "core/media/density_medium.h"

#include <algorithm>
#include <limits>

#include "core/phase_function.h"

namespace pssmlt {
namespace {

constexpr float coldest = 100.f, hottest = 20'000.f;  // that glow [K]

}  // namespace

std::unique_ptr<const Lattice<float>> make_lattice(const LatticeFrame& frame,
                                                   std::vector<float> values) {
  return std::make_unique<const Lattice<float>>(frame, std::move(values));
}

DensityMedium::DensityMedium(DensityParts parts)
    : substance_(parts.substance),
      extinction_(substance_.extinction()),
      density_(std::move(parts.density)),
      glow_(std::move(parts.glow)) {
  if (glow_.temperature) blackbody_.emplace(coldest, hottest);
}

MediumTraits DensityMedium::traits() const {
  return {.scatters = !is_black(substance_.scattering),
          .emits = glow_.any() && !is_black(substance_.absorption)};
}

Rgb DensityMedium::optical_depth(const Ray& ray) const {
  return extinction_ * density_->integral(ray);
}

std::optional<float> DensityMedium::distance(const Ray& ray, int channel, float depth) const {
  const float sigma = extinction_[channel];
  if (!(sigma > 0.f)) return std::nullopt;
  return density_->invert(ray, depth / sigma, [](float density) { return density; });
}

MediumPoint DensityMedium::at(const vec3& position) const {
  const float density = density_->at(position);
  MediumPoint point{extinction_ * density, substance_.scattering * density, Rgb(0.f)};
  if (glow_.any()) point.emission = substance_.absorption * density * emitted_radiance(position);
  return point;
}

Rgb DensityMedium::emitted_radiance(const vec3& position) const {
  const float factor = glow_.factor ? glow_.factor->at(position) : glow_.factor_constant;
  if (!blackbody_) return glow_.radiance * factor;
  const float kelvin = (glow_.temperature->at(position) - glow_.offset) * glow_.scale;
  return factor * (*blackbody_)(std::min(kelvin, hottest));
}

const Bsdf* DensityMedium::phase(const vec3&, BsdfStorage& storage) const {
  return storage.make<HenyeyGreenstein>(substance_.g);
}

LatticeFrame read_lattice_frame(Parameters& p) {
  LatticeFrame frame;
  frame.size.x = p.integer("nx", 1, "", "values along x");
  frame.size.y = p.integer("ny", 1, "", "values along y");
  frame.size.z = p.integer("nz", 1, "", "values along z");
  frame.low = p.point("p0", vec3(0.f), "m", "a corner of the box that the values fill");
  frame.high = p.point("p1", vec3(1.f), "m", "the opposite corner");
  frame.to_render = p.transform();
  if (p.describing()) return frame;
  constexpr std::string_view names[] = {"nx", "ny", "nz"};
  constexpr int most = 1 << 20;
  for (int i = 0; i < 3; ++i) {
    if (frame.size[i] < 1 || frame.size[i] > most) {
      p.fail(names[i], "\"" + std::string(names[i]) + "\" must lie between 1 and 1048576");
    }
    if (frame.low[i] > frame.high[i]) std::swap(frame.low[i], frame.high[i]);
    if (frame.low[i] == frame.high[i]) p.fail("p1", "the box from \"p0\" to \"p1\" is flat");
  }
  return frame;
}

void check_lattice_values(Parameters& p, std::string_view name, const LatticeFrame& frame,
                          const std::vector<float>& values) {
  const ivec3& n = frame.size;
  const auto wanted =
      static_cast<uint64_t>(n.x) * static_cast<uint64_t>(n.y) * static_cast<uint64_t>(n.z);
  if (values.size() != wanted) {
    p.fail(name, "\"" + std::string(name) + "\" has " + std::to_string(values.size()) +
                     " values where nx * ny * nz = " + std::to_string(wanted));
  }
  const bool negative = std::ranges::any_of(values, [](float v) { return !(v >= 0.f); });
  if (negative) p.fail(name, "\"" + std::string(name) + "\" must not be negative");
}

void read_temperature_range(Parameters& p, Glow& glow) {
  const float cutoff = p.number("temperaturecutoff", 0.f, "K", "older name of temperatureoffset");
  glow.offset = p.number("temperatureoffset", cutoff, "K", "taken off the temperatures");
  glow.scale = p.number("temperaturescale", 1.f, "", "factor of the temperatures after that");
}

}  // namespace pssmlt
