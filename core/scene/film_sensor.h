// What the film does to light: how much a picture gets of it, and which light is white.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "core/scene/parameters.h"

namespace pssmlt {

struct FilmSensor {
  double exposure = 1.0;    // factor of radiance
  glm::dmat3 balance{1.0};  // of linear Rec.709: the sensor's colours and white balance
};

// Reads pbrt-v4's "sensor", "iso", "exposuretime", "imagingratio" and "whitebalance". The time of
// the exposure is the camera's shutter [s] unless it is given. What a camera's sensor makes of
// colours is a matrix (core/color/camera_sensors.h), whose error is said in the log. Throws Error.
FilmSensor read_sensor(Parameters& film, float shutter_seconds, std::vector<std::string>& log);

}  // namespace pssmlt
