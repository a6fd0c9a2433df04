// A cumulus from noise, as pbrt-v4's cloud: octaves of noise, looked up at places that noise moves
// ("wispiness"), thinning out with the height y from 0 to 1. Source: Ebert, Musgrave, Peachey,
// Perlin, Worley 2003, Texturing and Modeling, as pbrt-v4 states it. The density is tabulated on a
// regular grid of "resolution" values an edge, in which free flight is exact: what is finer than
// its spacing is lost, which is seen from "frequency" above resolution / 40 or so.
#include "core/media/density_medium.h"
#include "core/noise.h"
#include "core/plugin/plugin.h"
#include "core/render/worker_pool.h"

namespace pssmlt {
namespace {

// As pbrt-v4: forward differences.
vec3 noise_gradient(const vec3& p) {
  constexpr float step = 0.01f;
  const float here = noise(p);
  const vec3 there(noise(p + vec3(step, 0.f, 0.f)), noise(p + vec3(0.f, step, 0.f)),
                   noise(p + vec3(0.f, 0.f, step)));
  return (there - here) / step;
}

struct CloudShape {
  float density = 1.f, wispiness = 1.f, frequency = 5.f;

  // At a point of the medium's space, in [0, 1].
  float at(const vec3& p) const {
    vec3 q = frequency * p;
    if (wispiness > 0.f) {
      float weight = 0.05f * wispiness, lambda = 10.f;
      for (int i = 0; i < 2; ++i) {
        q += weight * noise_gradient(lambda * q);
        weight *= 0.5f;
        lambda *= 1.99f;
      }
    }
    float d = 0.f, omega = 0.5f, lambda = 1.f;
    for (int i = 0; i < 5; ++i) {
      d += omega * noise(lambda * q);
      omega *= 0.5f;
      lambda *= 1.99f;
    }
    d = glm::clamp((1.f - p.y) * 4.5f * density * d, 0.f, 1.f);
    d += 2.f * std::fmax(0.f, 0.5f - p.y);
    return glm::clamp(d, 0.f, 1.f);
  }
};

class Cloud final : public DensityMedium {
 public:
  static constexpr const char* summary = "a cumulus cloud from noise";

  explicit Cloud(Parameters& p) : DensityMedium(read(p)) {}

 private:
  static DensityParts read(Parameters& p) {
    LatticeFrame frame;
    frame.low = p.point("p0", vec3(0.f), "m", "a corner of the box that the cloud fills");
    frame.high = p.point("p1", vec3(1.f), "m", "the opposite corner");
    frame.to_render = p.transform();
    DensityParts parts{ScatteringParameters(p, false, Rgb(1.f), Rgb(1.f)), nullptr, {}};
    CloudShape shape;
    shape.density = p.number("density", 1.f, "", "factor of the density");
    shape.wispiness = p.number("wispiness", 1.f, "", "how much the noise is frayed");
    shape.frequency = p.number("frequency", 5.f, "1/m", "of the widest noise");
    const int resolution =
        p.integer("resolution", 192, "", "values along the longest edge of the box");
    if (p.describing()) return parts;
    if (resolution < 2 || resolution > 1024) {
      p.fail("resolution", "\"resolution\" must lie between 2 and 1024");
    }
    for (int i = 0; i < 3; ++i) {
      if (frame.low[i] > frame.high[i]) std::swap(frame.low[i], frame.high[i]);
      if (frame.low[i] == frame.high[i]) p.fail("p1", "the box from \"p0\" to \"p1\" is flat");
    }
    parts.density = tabulate(frame, shape, resolution);
    return parts;
  }

  static std::unique_ptr<const Lattice<float>> tabulate(LatticeFrame frame, const CloudShape& shape,
                                                        int resolution) {
    const vec3 extent = frame.high - frame.low;
    const float spacing = max_component(extent) / static_cast<float>(resolution);
    for (int i = 0; i < 3; ++i) {
      frame.size[i] = std::max(1, static_cast<int>(std::ceil(extent[i] / spacing - 1e-3f)));
    }
    const ivec3 n = frame.size;
    const auto plane = static_cast<size_t>(n.x) * static_cast<size_t>(n.y);
    std::vector<float> values(plane * static_cast<size_t>(n.z));
    WorkerPool(0).run(n.z, [&](int z, int) {
      float* out = &values[plane * static_cast<size_t>(z)];
      for (int y = 0; y < n.y; ++y) {
        for (int x = 0; x < n.x; ++x) {
          const vec3 part = (vec3(x, y, z) + 0.5f) / vec3(n);
          *out++ = shape.at(frame.low + part * extent);
        }
      }
    });
    return make_lattice(frame, std::move(values));
  }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Medium, "cloud", pssmlt::Cloud)
