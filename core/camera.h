// Cameras. A camera maps raster positions [pixels; (0,0) is the upper left corner of the full
// picture] and lens positions to rays, and back.
#pragma once

#include "core/endpoint.h"

namespace pssmlt {

// The picture as cameras see it.
struct RasterFrame {
  ivec2 resolution{1, 1};          // full picture [pixels]
  ivec2 crop_min{0, 0};            // rendered window, inclusive
  ivec2 crop_max{1, 1};            // exclusive
  vec2 filter_radius{0.5f, 0.5f};  // [pixels]: light that lands this far outside still counts
  float diagonal = 35.f;           // of the film, for cameras that have one [mm]
  ivec2 crop_size() const { return crop_max - crop_min; }
  double pixels() const { return static_cast<double>(crop_size().x) * crop_size().y; }
  // The window with the filter's radius around it, and whether a raster position lies there.
  dvec2 low() const { return dvec2(crop_min) - dvec2(filter_radius); }
  dvec2 high() const { return dvec2(crop_max) + dvec2(filter_radius); }
  bool shows(const dvec2& raster) const {
    return raster.x >= low().x && raster.x <= high().x && raster.y >= low().y &&
           raster.y <= high().y;
  }
};

// emit(): u_direction is the raster position [pixels]. Densities and importance are relative to
// the rendered window: pdf_direction = (pixels per steradian) / (pixels in the window), and of
// cameras that measure radiance importance * cosine = pdf_position * pdf_direction. Only the
// product of the two densities has a meaning of its own: users of cameras never take one without
// the other.
class Camera : public Endpoint {
 public:
  // Raster position [pixels] of the ray from a point on the lens along `direction` (unit, away
  // from the camera); nullopt behind the camera or further than the filter's radius outside the
  // rendered window.
  virtual std::optional<dvec2> raster(const vec3& lens_point, const vec3& direction) const = 0;
  // Optical centre in render space.
  virtual vec3 center() const = 0;
  // Diameter of a pixel at distance 1 [m/m] (orthographic: [m] at any distance, see below).
  virtual float pixel_spread() const = 0;
  // True if a pixel's footprint does not grow with distance.
  virtual bool parallel() const { return false; }
  // True if pixels hold irradiance [W/m^2], on a surface or at the film behind lenses; otherwise
  // they hold radiance [W/(m^2 sr)].
  virtual bool measures_irradiance() const { return false; }
  // True for a bare surface: its points see a hemisphere, with the same importance along all
  // directions, which emit() draws in proportion to their cosine, and the raster position follows
  // from the point (or is drawn, where all points are one). Light can then be drawn for a point as
  // for any other diffuse surface's.
  virtual bool bare() const { return false; }
};

}  // namespace pssmlt
