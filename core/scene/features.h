// What a scene contains, computed once by the builder: it selects code paths specialised without
// what is absent and answers which path classes can carry light at all.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pssmlt {

struct SceneFeatures {
  bool alpha = false;   // any cut-outs
  bool media = false;   // any participating media
  bool motion = false;  // anything moves while the shutter is open
  bool instances = false;
  bool material_numbers = false;  // any material that draws numbers of its own (mix)
  bool dispersion = false;        // any material that scatters by wavelength
  bool connectible = false;       // any material with non-delta lobes (D)
  bool specular = false;          // any material with delta lobes (S)
  bool transmissive = false;
  bool area_lights = false;      // A in path expressions
  bool infinite_lights = false;  // I: environment, can be hit by leaving rays
  bool delta_lights = false;     // P: point, spot, distant
  bool emitting_media = false;   // V
  bool delta_lens = false;       // pinhole
  bool textures = false;
  int lights = 0;
  uint64_t triangles = 0, user_shapes = 0, instance_count = 0;
  uint64_t accel_bytes = 0;  // memory of the acceleration structure [bytes]
  double load_seconds = 0.0, accel_seconds = 0.0;
  std::vector<std::string> left_out;  // what was not loaded or built, for the log and `info`
};

}  // namespace pssmlt
