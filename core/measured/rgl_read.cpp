// RglBrdf: what reads and checks its file.
#include <algorithm>

#include "core/base/error.h"
#include "core/color/spectrum.h"
#include "core/measured/rgl_brdf.h"

namespace pssmlt {
namespace {

constexpr uint64_t largest_axis = 1 << 14;

int extent(uint64_t n, const std::string& name) {
  if (n < 2 || n > largest_axis)
    throw Error("field \"" + name + "\" has " + std::to_string(n) +
                " nodes along an axis, not 2 to " + std::to_string(largest_axis));
  return static_cast<int>(n);
}

std::vector<float> ascending(TensorFile& file, const std::string& name) {
  file.shape(name, 1);
  std::vector<float> values = file.floats(name);
  if (std::ranges::adjacent_find(values, std::greater_equal<>()) != values.end())
    throw Error("the values of \"" + name + "\" do not ascend");
  return values;
}

void refuse_negative(const std::vector<float>& values, const std::string& name) {
  if (std::ranges::any_of(values, [](float v) { return v < 0.f; }))
    throw Error("field \"" + name + "\" has a negative value");
}

// How much of linear Rec.709 each of the wavelengths is: linear in between, the ends continue.
std::vector<dvec3> wavelength_weights(const std::vector<float>& wavelengths) {
  std::vector<dvec3> weights(wavelengths.size(), dvec3(0.0));
  double lambda = lambda_min;
  for (const dvec3& weight : reflectance_weights()) {
    const auto after = std::ranges::upper_bound(wavelengths, static_cast<float>(lambda));
    const auto i = static_cast<size_t>(after - wavelengths.begin());
    if (i == 0 || i == wavelengths.size()) {
      weights[i == 0 ? 0 : i - 1] += weight;
    } else {
      const auto low = static_cast<double>(wavelengths[i - 1]),
                 high = static_cast<double>(wavelengths[i]);
      const double t = (lambda - low) / (high - low);
      weights[i - 1] += (1.0 - t) * weight;
      weights[i] += t * weight;
    }
    ++lambda;
  }
  return weights;
}

}  // namespace

RglBrdf::RglBrdf(const std::string& path) {
  TensorFile file(path);
  read_axes(file);
  jacobian_ = !file.has("jacobian") || file.byte("jacobian") != 0;
  ndf_ = read_field(file, "ndf");
  sigma_ = read_field(file, "sigma");
  visible_ = read_warp(file, "vndf");
  luminance_ = read_warp(file, "luminance");
  read_colours(file);
}

void RglBrdf::read_axes(TensorFile& file) {
  std::vector<float> phi = ascending(file, "phi_i"), theta = ascending(file, "theta_i");
  if (phi.size() > largest_axis || theta.size() > largest_axis)
    throw Error("\"phi_i\" or \"theta_i\" has too many values");
  isotropic_ = phi.size() <= 2;
  if (!isotropic_) read_symmetry(phi);
  axes_ = GridAxes(std::move(phi), std::move(theta));
}

// Materials that look the same from opposite sides, or in a mirror too, were measured in part.
void RglBrdf::read_symmetry(const std::vector<float>& phi) {
  const float range = phi.back() - phi.front();
  symmetry_ = static_cast<int>(std::lround(2.f * pi / range));
  if (symmetry_ != 1 && symmetry_ != 2 && symmetry_ != 4)
    throw Error("\"phi_i\" covers " + std::to_string(range) +
                " rad: neither a whole circle nor a half or a quarter of one");
  const float middle = 0.5f * (phi.front() + phi.back());
  middle_ = {std::cos(middle), std::sin(middle)};
}

RglBrdf::Field RglBrdf::read_field(TensorFile& file, const std::string& name) {
  const std::vector<uint64_t>& shape = file.shape(name, 2);
  Field field;
  field.height = extent(shape[0], name);
  field.width = extent(shape[1], name);
  field.values = file.floats(name);
  refuse_negative(field.values, name);
  return field;
}

void RglBrdf::check_shape(const std::string& name, const std::vector<uint64_t>& shape) const {
  if (shape[0] != axes_.first().size() || shape[1] != axes_.second().size())
    throw Error("field \"" + name + "\" is for " + std::to_string(shape[0]) + " x " +
                std::to_string(shape[1]) + " directions, the file has " +
                std::to_string(axes_.first().size()) + " x " +
                std::to_string(axes_.second().size()));
}

BilinearWarp RglBrdf::read_warp(TensorFile& file, const std::string& name) const {
  const std::vector<uint64_t>& shape = file.shape(name, 4);
  check_shape(name, shape);
  std::vector<float> values = file.floats(name);
  refuse_negative(values, name);
  return BilinearWarp(std::move(values), extent(shape[3], name), extent(shape[2], name));
}

void RglBrdf::read_colours(TensorFile& file) {
  if (file.has("spectra"))
    return read_rgb(file, "spectra", wavelength_weights(ascending(file, "wavelengths")));
  read_rgb(file, "rgb", {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
}

// A direction of wo at a time: the spectra of a file may be larger than all else by far.
void RglBrdf::read_rgb(TensorFile& file, const std::string& name,
                       const std::vector<dvec3>& weights) {
  const std::vector<uint64_t>& shape = file.shape(name, 5);
  check_shape(name, shape);
  if (shape[2] != weights.size())
    throw Error("field \"" + name + "\" has " + std::to_string(shape[2]) + " channels, not " +
                std::to_string(weights.size()));
  height_ = extent(shape[3], name);
  width_ = extent(shape[4], name);
  const size_t size = static_cast<size_t>(width_) * static_cast<size_t>(height_);
  colours_.reserve(size * axes_.count());
  std::vector<dvec3> sums(size);
  for (size_t grid = 0; grid < axes_.count(); ++grid) {
    std::ranges::fill(sums, dvec3(0.0));
    const std::vector<float> values =
        file.floats(name, grid * size * weights.size(), size * weights.size());
    for (size_t i = 0; i < values.size(); ++i)
      sums[i % size] += static_cast<double>(values[i]) * weights[i / size];
    for (const dvec3& sum : sums) colours_.emplace_back(sum);
  }
}

}  // namespace pssmlt
