#include "core/scene/film_sensor.h"

#include <fmt/format.h>

#include "core/color/camera_sensors.h"
#include "core/color/color_space.h"

namespace pssmlt {
namespace {

constexpr float camera_white = 6500.f;  // of cameras, unless the scene says another [K]

constexpr std::string_view observer = "cie1931";  // the standard one, no camera

std::vector<std::string_view> sensor_names() {
  std::vector<std::string_view> names = camera_sensor_names();
  names.insert(names.begin(), observer);
  return names;
}

// The camera's colours, balanced for a temperature [K].
glm::dmat3 camera_balance(const std::string& name, float white, std::vector<std::string>& log) {
  const CameraSensor camera = camera_sensor(name).value();
  log.push_back(fmt::format(
      "film: sensor \"{}\" is a matrix fitted to its measured curves, balanced for {:g} "
      "K: components are off by {:.1f} % of the largest (rms), by {:.0f} % at worst, of "
      "the most saturated colours",
      name, white, 100.0 * camera.rms, 100.0 * camera.worst));
  return camera.matrix * camera_white_balance(static_cast<double>(white));
}

}  // namespace

FilmSensor read_sensor(Parameters& film, float shutter_seconds, std::vector<std::string>& log) {
  const std::string sensor =
      film.choice("sensor", observer, sensor_names(), "response of the sensor");
  const float iso = film.number("iso", 100.f, "", "film speed; the picture scales with iso / 100");
  const float time = film.number("exposuretime", shutter_seconds, "s",
                                 "time of the exposure; default: how long the shutter is open");
  const float ratio =
      film.number("imagingratio", 0.f, "", "factor of radiance, instead of time * iso / 100");
  const float white =
      film.number("whitebalance", 0.f, "K", "temperature of what is white; 0: none");
  if (!(iso > 0.f)) film.fail("iso", "\"iso\" must be positive");
  if (!(time > 0.f)) film.fail("exposuretime", "\"exposuretime\" must be positive");
  if (!(ratio >= 0.f)) film.fail("imagingratio", "\"imagingratio\" must not be negative");
  if (white != 0.f && !(white >= 1000.f && white <= 25000.f))
    film.fail("whitebalance", "\"whitebalance\" must lie between 1000 and 25000 K, or be 0");
  FilmSensor result;
  result.exposure = static_cast<double>(iso) * static_cast<double>(time) / 100.0;
  if (ratio > 0.f) result.exposure = static_cast<double>(ratio);
  if (sensor != observer)
    result.balance = camera_balance(sensor, white == 0.f ? camera_white : white, log);
  else if (white != 0.f)
    result.balance = white_balance(static_cast<double>(white));
  return result;
}

}  // namespace pssmlt
