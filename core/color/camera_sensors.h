// What the sensors of pbrt-v4's cameras make of colours, as matrices on linear Rec.709.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace pssmlt {

// A camera weighs spectra by three measured curves. Rendering is in RGB, so that the nearest there
// is to the camera is a matrix fitted to what it makes of smooth spectra; white is exact.
struct CameraSensor {
  glm::dmat3 matrix;  // linear Rec.709 to linear Rec.709, balanced for 6500 K
  // Root of the mean square and largest error of a component, relative to the largest component of
  // the colour, over the colours of Rec.709.
  double rms, worst;
};

// Null if there is no camera of this name ("canon_eos_100d", ...).
std::optional<CameraSensor> camera_sensor(std::string_view name);

const std::vector<std::string_view>& camera_sensor_names();

// What to apply before a camera's matrix if its white is light of another temperature than 6500 K
// [K, 1000 to 25000]: light of that temperature becomes the light of 6500 K. A camera is balanced
// by least squares over a chart, which Bradford's adaptation, made for the eye, is far from. Errors
// of both steps against the curves (rms of components over the camera's largest, of reflectances
// whose smallest component is above a fifth of the largest), lit by the white itself and by D65:
//   2000 K 5.8 and 10.6 %, 3200 K 2.1 and 3.6 %, 10000 K 1.8 and 1.7 %, 20000 K 2.9 and 2.6 %;
// by Bradford 12.8 and 13.0 %, 5.7 and 6.2 %, 1.6 and 2.0 %, 2.2 and 3.1 %. White, which stays that
// of 6500 K, is off by up to 5, 2, 1 and 2 %.
glm::dmat3 camera_white_balance(double temperature);

}  // namespace pssmlt
