#include "app/metrics/flip.h"

#include <algorithm>
#include <cmath>

#include "app/metrics/flip_observer.h"
#include "core/base/error.h"

namespace pssmlt::flip {
namespace {

void check(const View& picture, const View& reference, double pixels_per_degree) {
  if (picture.width != reference.width || picture.height != reference.height) {
    throw Error("FLIP compares images of one size");
  }
  if (!(pixels_per_degree >= 1.0 && pixels_per_degree <= 1000.0)) {
    throw Error("FLIP: pixels per degree must be 1 to 1000");
  }
}

// The largest error over `times` looks; show(time, colour) is what is displayed of a colour.
template <typename Show>
Plane largest_error(const View& picture, const View& reference, int times, const Show& show,
                    WorkerPool& pool, double pixels_per_degree) {
  check(picture, reference, pixels_per_degree);
  const int width = reference.width, height = reference.height;
  Observer observer(width, height, pixels_per_degree, pool);
  Appearance seen[2] = {{width, height}, {width, height}};
  const View* const views[2] = {&picture, &reference};
  Plane error(width, height);
  for (int time = 0; time < times; ++time) {
    for (size_t i = 0; i < 2; ++i) {
      const auto row = [&](int y, std::span<Rgb> out) {
        const size_t first = static_cast<size_t>(y) * out.size();
        std::ranges::transform(views[i]->colours.subspan(first, out.size()), out.begin(),
                               [&](const Rgb& colour) { return show(time, colour); });
      };
      observer.look(row, seen[i]);
    }
    observer.raise(seen[0], seen[1], error);
  }
  return error;
}

}  // namespace

Plane displayed_error(const View& picture, const View& reference, WorkerPool& pool,
                      double pixels_per_degree) {
  const auto show = [](int, const Rgb& colour) { return glm::clamp(colour, 0.f, 1.f); };
  return largest_error(picture, reference, 1, show, pool, pixels_per_degree);
}

Plane radiance_error(const View& picture, const View& reference, WorkerPool& pool,
                     double pixels_per_degree) {
  const Exposures exposures = exposures_for(reference.colours);
  std::vector<double> factors;
  for (int e = 0; e < exposures.count; ++e) factors.push_back(std::exp2(exposures.at(e)));
  const auto show = [&factors](int time, const Rgb& colour) {
    const dvec3 exposed = dvec3(colour) * factors[static_cast<size_t>(time)];
    return Rgb(tone_mapped(exposed.x), tone_mapped(exposed.y), tone_mapped(exposed.z));
  };
  return largest_error(picture, reference, exposures.count, show, pool, pixels_per_degree);
}

}  // namespace pssmlt::flip
