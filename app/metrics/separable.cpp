#include "app/metrics/separable.h"

#include <algorithm>

namespace pssmlt {
namespace {

// out += weight * in, the loop that everything waits for.
void add_scaled(const float* in, float weight, std::span<float> out) {
  float* const to = out.data();
  const size_t count = out.size();
  for (size_t x = 0; x < count; ++x) to[x] += weight * in[x];
}

}  // namespace

void filter_row(std::span<const float> in, const Kernel& kernel, std::vector<float>& padded,
                std::span<float> out) {
  const size_t radius = kernel.size() / 2;
  padded.resize(in.size() + 2 * radius);
  const auto middle = padded.begin() + static_cast<std::ptrdiff_t>(radius);
  std::fill(padded.begin(), middle, in.front());
  std::fill(std::ranges::copy(in, middle).out, padded.end(), in.back());
  std::ranges::fill(out, 0.f);
  for (size_t k = 0; k < kernel.size(); ++k) add_scaled(padded.data() + k, kernel[k], out);
}

void filter_column(const Plane& in, int y, const Kernel& kernel, std::span<float> out) {
  const int radius = static_cast<int>(kernel.size() / 2);
  std::ranges::fill(out, 0.f);
  for (int k = -radius; k <= radius; ++k) {
    const int from = std::clamp(y + k, 0, in.height - 1);
    add_scaled(in.row(from).data(), kernel[static_cast<size_t>(k + radius)], out);
  }
}

}  // namespace pssmlt
