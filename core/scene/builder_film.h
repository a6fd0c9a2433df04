// The film's side of building: picture size, crop window, exposure.
#pragma once

#include "core/scene/builder.h"
#include "core/scene/film_sensor.h"

namespace pssmlt {

struct FilmDirective {
  RasterFrame frame;  // filter_radius left for the filter
  std::string output;
  float max_component = infinity;
  FilmSensor sensor;
  std::vector<std::string> layers;  // beside the picture, named as --aux names them
  bool camera_normals = false;      // a layer of normals has the camera's axes, not the world's
};

// Reads Film with the command line's size, scale and crop. Throws Error (located) on sizes and
// windows that make no picture. Notes go to log.
FilmDirective read_film(const SceneDescription& scene, const BuildOptions& options,
                        std::vector<std::string>& log);

// When the camera's shutter opens and closes [s]. Throws Error if it closes before it opens.
std::array<float, 2> shutter_times(const Directive& camera);
// Throws Error at the filter (`parameters`: its) if it is too wide.
std::shared_ptr<const RasterMap> make_raster_map(const RasterFrame& frame,
                                                 std::shared_ptr<const Filter> filter,
                                                 const Parameters& parameters);

}  // namespace pssmlt
