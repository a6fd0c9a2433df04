#include "core/color/blackbody_rgb.h"

#include <algorithm>

#include "core/color/spectrum.h"

namespace pssmlt {
namespace {

constexpr int entries = 512;

Rgb color(double temperature) {
  const Samples samples = blackbody_samples(temperature);
  const auto at = [&](double lambda) { return evaluate(samples, lambda, Outside::Zero); };
  const double y = xyz_integral(at).y;
  const double white = xyz_integral([](double) { return 1.0; }).y;
  const dvec3 rgb = emission_rgb(samples, Outside::Zero) * (y / white);
  return Rgb(glm::max(rgb, dvec3(0.0)));
}

}  // namespace

BlackbodyRgb::BlackbodyRgb(float from, float to)
    : from_(from), step_(std::max(to - from, 1.f) / (entries - 1)) {
  for (int i = 0; i < entries; ++i) {
    table_.push_back(color(static_cast<double>(from_ + step_ * static_cast<float>(i))));
  }
}

Rgb BlackbodyRgb::operator()(float temperature) const {
  const float at = (temperature - from_) / step_;
  if (!(at >= 0.f) || at > static_cast<float>(entries - 1)) return Rgb(0.f);
  const auto i = std::min(static_cast<size_t>(at), table_.size() - 2);
  const float f = at - static_cast<float>(i);
  return (1.f - f) * table_[i] + f * table_[i + 1];
}

}  // namespace pssmlt
