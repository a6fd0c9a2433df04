#include "core/scene/film_sensor.h"

#include <fmt/format.h>

#include <array>

#include "core/color/color_space.h"

namespace pssmlt {
namespace {

// pbrt-v4's sensors; the first is the standard observer itself.
constexpr std::array<std::string_view, 18> sensors = {
    "cie1931",           "canon_eos_100d",      "canon_eos_1dx_mkii",
    "canon_eos_200d",    "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii", "canon_eos_5d_mkiii",  "canon_eos_5d_mkiv",
    "canon_eos_5ds",     "canon_eos_m",         "hasselblad_l1d_20c",
    "nikon_d810",        "nikon_d850",          "sony_ilce_6400",
    "sony_ilce_7m3",     "sony_ilce_7rm3",      "sony_ilce_9"};

constexpr float camera_white = 6500.f;  // of cameras, unless the scene says another [K]

}  // namespace

FilmSensor read_sensor(Parameters& film, float shutter_seconds, std::vector<std::string>& log) {
  const std::string sensor = film.choice("sensor", sensors[0], sensors, "response of the sensor");
  const float iso = film.number("iso", 100.f, "", "film speed; the picture scales with iso / 100");
  const float time = film.number("exposuretime", shutter_seconds, "s",
                                 "time of the exposure; default: how long the shutter is open");
  const float ratio =
      film.number("imagingratio", 0.f, "", "factor of radiance, instead of time * iso / 100");
  float white = film.number("whitebalance", 0.f, "K", "temperature of what is white; 0: none");
  if (!(iso > 0.f)) film.fail("iso", "\"iso\" must be positive");
  if (!(time > 0.f)) film.fail("exposuretime", "\"exposuretime\" must be positive");
  if (!(ratio >= 0.f)) film.fail("imagingratio", "\"imagingratio\" must not be negative");
  if (white != 0.f && !(white >= 1000.f && white <= 25000.f))
    film.fail("whitebalance", "\"whitebalance\" must lie between 1000 and 25000 K, or be 0");
  const bool camera = sensor != sensors[0];
  if (camera && white == 0.f) white = camera_white;
  FilmSensor result;
  result.exposure = static_cast<double>(iso) * static_cast<double>(time) / 100.0;
  if (ratio > 0.f) result.exposure = static_cast<double>(ratio);
  if (white != 0.f) result.balance = white_balance(static_cast<double>(white));
  if (camera) {
    log.push_back(
        fmt::format("film: the measured curves of sensor \"{}\" are not here: colours are "
                    "the standard observer's, balanced for {:g} K",
                    sensor, white));
  }
  return result;
}

}  // namespace pssmlt
