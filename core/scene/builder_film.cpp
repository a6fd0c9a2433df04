#include "core/scene/builder_film.h"

#include <algorithm>
#include <cmath>

namespace pssmlt {
namespace {

// More pixels than this need more memory for their sums than machines have.
constexpr double max_pixels = 4.0e8;
// Pixel coordinates are ints, with room for the filter around them.
constexpr double max_side = 0x1p30;

// pbrt's crop window in normalised coordinates to pixels.
void crop_by_fractions(const std::vector<float>& window, RasterFrame& frame,
                       const Parameters& film) {
  if (window.size() != 4) film.fail("cropwindow", "cropwindow needs 4 numbers: x0 x1 y0 y1");
  const vec2 size(frame.resolution);
  const auto pixel = [](float fraction, float extent) {
    return static_cast<int>(std::ceil(std::clamp(fraction, 0.f, 1.f) * extent));
  };
  const auto [x0, x1] = std::minmax(window[0], window[1]);
  const auto [y0, y1] = std::minmax(window[2], window[3]);
  frame.crop_min = {pixel(x0, size.x), pixel(y0, size.y)};
  frame.crop_max = {pixel(x1, size.x), pixel(y1, size.y)};
}

void crop_by_pixels(const std::vector<int>& bounds, RasterFrame& frame, const Parameters& film) {
  if (bounds.size() != 4) film.fail("pixelbounds", "pixelbounds needs 4 integers: x0 x1 y0 y1");
  frame.crop_min = glm::max(ivec2(bounds[0], bounds[2]), ivec2(0));
  frame.crop_max = glm::min(ivec2(bounds[1], bounds[3]), frame.resolution);
}

void check_frame(const RasterFrame& frame, const Parameters& film) {
  const ivec2 size = frame.crop_size();
  if (size.x <= 0 || size.y <= 0) film.fail("the crop window has no pixels");
  if (frame.pixels() > max_pixels) {
    film.fail("a window of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
              " pixels is too large (at most 4e8 pixels)");
  }
}

void read_size(Parameters& film, const BuildOptions& options, RasterFrame& frame) {
  ivec2 size;
  size.x = film.integer("xresolution", 1280, "pixels", "width of the full picture");
  size.y = film.integer("yresolution", 720, "pixels", "height of the full picture");
  if (options.size) size = *options.size;
  if (size.x <= 0 || size.y <= 0) {
    film.fail("the picture has no pixels: " + std::to_string(size.x) + " x " +
              std::to_string(size.y));
  }
  if (!(options.scale > 0.f)) throw Error("--scale must be positive");
  const dvec2 scaled = glm::round(dvec2(size) * static_cast<double>(options.scale));
  if (!(scaled.x < max_side && scaled.y < max_side)) {
    film.fail("a picture of this size is too large (at most 2^30 pixels a side)");
  }
  size = glm::max(ivec2(1), ivec2(scaled));
  frame.resolution = size;
  frame.crop_min = ivec2(0);
  frame.crop_max = size;
}

// How long the camera's shutter is open [s]; the camera checks the parameters' types.
float shutter_time(const ParameterSet& camera, const Location& where) {
  float open = 0.f, close = 1.f;
  for (const Parameter& p : camera) {
    if (p.floats.size() != 1) continue;
    if (p.name == "shutteropen") open = p.floats[0];
    if (p.name == "shutterclose") close = p.floats[0];
  }
  if (!(close > open)) throw Error(where, "the camera's shutter closes before it opens");
  return close - open;
}

void read_sensor(Parameters& film, float shutter_seconds, FilmDirective& settings,
                 std::vector<std::string>& log) {
  const std::string sensor = film.text("sensor", "cie1931", "response of the sensor");
  if (sensor != "cie1931") {
    film.fail("sensor", "sensor \"" + sensor + "\" is not supported yet (only \"cie1931\")");
  }
  const float iso = film.number("iso", 100.f, "", "film speed; the picture scales with iso / 100");
  settings.exposure = static_cast<double>(iso) * static_cast<double>(shutter_seconds) / 100.0;
  if (film.number("whitebalance", 0.f, "K", "white balance, 0: none") != 0.f) {
    film.fail("whitebalance", "whitebalance is not supported yet");
  }
  film.flag("savefp16", true, "pbrt writes half floats; this program always writes floats");
  film.number("diagonal", 35.f, "mm", "of the film, for realistic cameras");
  settings.max_component = film.number("maxcomponentvalue", infinity, "W/(m^2 sr)",
                                       "clamp of a sample's largest component, if asked for");
  if (std::isfinite(settings.max_component)) {
    log.push_back("film: maxcomponentvalue is read, not applied (--honour-clamp applies it)");
  }
}

}  // namespace

FilmDirective read_film(const SceneDescription& scene, const BuildOptions& options,
                        std::vector<std::string>& log) {
  if (scene.film.given() && scene.film.type != "rgb") {
    throw Error(scene.film.where,
                "film \"" + scene.film.type + "\" is unknown or not supported yet");
  }
  Parameters film(scene.film.parameters, scene.film.where, "film \"rgb\"", nullptr);
  FilmDirective settings;
  RasterFrame& frame = settings.frame;
  read_size(film, options, frame);
  const std::vector<float> window =
      film.numbers("cropwindow", "", "rendered part, fractions x0 x1 y0 y1");
  const std::vector<int> bounds =
      film.integers("pixelbounds", "pixels", "rendered part, x0 x1 y0 y1");
  if (!window.empty()) crop_by_fractions(window, frame, film);
  if (!bounds.empty()) crop_by_pixels(bounds, frame, film);
  if (options.crop) {
    const auto& c = *options.crop;
    crop_by_pixels({c[0], c[1], c[2], c[3]}, frame, film);
  }
  check_frame(frame, film);
  settings.output = film.text("filename", "pbrt.exr", "where the picture is written");
  read_sensor(film, shutter_time(scene.camera.parameters, scene.camera.where), settings, log);
  if (!options.honour_clamp) settings.max_component = infinity;
  film.check_all_read();
  if (scene.color_space != "srgb") {
    log.push_back("film: the picture is written in linear Rec.709, not in \"" + scene.color_space +
                  "\"");
  }
  return settings;
}

}  // namespace pssmlt
