#include "core/render/auxiliary.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/path/surface.h"
#include "core/render/worker_pool.h"

namespace pssmlt {
namespace {

// Sums over one pixel's rays; filters with negative lobes give negative weights.
struct PixelSums {
  Rgb albedo{0.f};
  vec3 normal{0.f};
  float depth = 0.f, weight = 0.f, hit_weight = 0.f;
};

void add_ray(const Scene& scene, const Emission& ray, float time, float u_alpha, float weight,
             PixelSums& sums) {
  sums.weight += weight;
  const Ray leaving{ray.from.position, ray.direction, infinity, time};
  Surface surface;
  if (!scene.intersect(leaving, u_alpha, surface.hit)) return;
  sums.hit_weight += weight;
  sums.depth += weight * surface.hit.distance;
  const bool scatters = surface.shade(scene, -ray.direction, MaterialNumbers{0.5f, 0.5f});
  if (!scatters) {
    sums.normal += weight * scene.shading_frame(surface.hit).n;
    return;
  }
  sums.normal += weight * surface.frame().n;
  sums.albedo += weight * surface.bsdf()->albedo(surface.frame().to_local(-ray.direction));
}

PixelSums render_pixel(const Scene& scene, const RasterMap& map, uint64_t seed, int pixel) {
  PixelSums sums;
  for (int ray = 0; ray < auxiliary_rays; ++ray) {
    const auto use = static_cast<uint32_t>(RandomUse::auxiliary);
    const auto at = static_cast<uint32_t>(ray);
    const RandomBlock a = philox(seed, {static_cast<uint32_t>(pixel), at, 0, use});
    const RandomBlock b = philox(seed, {static_cast<uint32_t>(pixel), at, 1, use});
    // The offsets are stratified 4 x 4.
    const double x = (ray % 4 + to_unit_double(a[0])) / 4.0;
    const double y = (ray / 4 + to_unit_double(a[1])) / 4.0;
    const RasterMap::CameraPoint point = map.camera_point_in(pixel, x, y);
    const float time = scene.time(to_unit(b[1]));
    const vec2 lens(to_unit(a[2]), to_unit(a[3]));
    const auto emission = scene.camera_emit(lens, point.raster, time);
    if (emission) add_ray(scene, *emission, time, to_unit(b[0]), point.credit.weight, sums);
  }
  return sums;
}

void set(Image& image, int pixel, const vec3& value) {
  float* const p = &image.data[static_cast<size_t>(pixel) * 3];
  for (int c = 0; c < 3; ++c) p[c] = value[c];
}

}  // namespace

AuxiliaryImages render_auxiliary(const BuiltScene& scene, uint64_t seed, int threads) {
  const RasterMap& map = *scene.raster_map;
  const ivec2 size = map.frame().crop_size();
  AuxiliaryImages images{Image(size.x, size.y, 3), Image(size.x, size.y, 3),
                         Image(size.x, size.y, 1)};
  images.normal.channel_names = {"X", "Y", "Z"};
  images.depth.channel_names = {"Z"};
  WorkerPool(threads).run(size.y, [&](int y, int) {
    for (int x = 0; x < size.x; ++x) {
      const int pixel = y * size.x + x;
      const PixelSums sums = render_pixel(*scene.scene, map, seed, pixel);
      if (!(sums.weight > 0.f)) continue;
      set(images.albedo, pixel, sums.albedo / sums.weight);
      set(images.normal, pixel, vec3(scene.normal_axes * dvec3(sums.normal / sums.weight)));
      if (sums.hit_weight > 0.f) {
        images.depth.data[static_cast<size_t>(pixel)] = sums.depth / sums.hit_weight;
      }
    }
  });
  return images;
}

Image error_image(const Image& variance) {
  Image result(variance.width, variance.height, 1);
  result.channel_names = {"Y"};
  constexpr int reach = 2;
  // The luminance's variance if the channels' errors go together, as they mostly do.
  const auto deviation = [&](int x, int y) {
    const float* const v = variance.pixel(x, y);
    return luminance(Rgb(std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2])));
  };
  for (int y = 0; y < variance.height; ++y) {
    for (int x = 0; x < variance.width; ++x) {
      float sum = 0.f;
      int count = 0;
      for (int j = std::max(0, y - reach); j <= std::min(variance.height - 1, y + reach); ++j) {
        for (int i = std::max(0, x - reach); i <= std::min(variance.width - 1, x + reach); ++i) {
          sum += sqr(deviation(i, j));
          ++count;
        }
      }
      *result.pixel(x, y) = std::sqrt(sum / static_cast<float>(count));
    }
  }
  return result;
}

}  // namespace pssmlt
