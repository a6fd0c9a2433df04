#include "core/scene/builder_film.h"

#include <algorithm>
#include <array>
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

void read_output(Parameters& film, FilmDirective& settings, std::vector<std::string>& log) {
  film.flag("savefp16", true, "pbrt writes half floats; this program always writes floats");
  settings.frame.diagonal =
      film.number("diagonal", 35.f, "mm", "of the film, for cameras that have lenses");
  if (!(settings.frame.diagonal > 0.f)) film.fail("diagonal", "\"diagonal\" must be positive");
  settings.max_component = film.number("maxcomponentvalue", infinity, "W/(m^2 sr)",
                                       "clamp of a sample's largest component, if asked for");
  if (std::isfinite(settings.max_component)) {
    log.push_back("film: maxcomponentvalue is read, not applied (--honour-clamp applies it)");
  }
}

// What denoisers want, of pbrt-v4's "gbuffer".
void read_layers(Parameters& film, FilmDirective& settings) {
  constexpr std::array<std::string_view, 2> spaces = {"camera", "world"};
  const std::string space = film.choice("coordinatesystem", spaces[0], spaces, "of the normals");
  settings.layers = {"albedo", "normal", "depth", "variance"};
  settings.camera_normals = space == spaces[0];
}

// The buckets of pbrt-v4's "spectral" would need light by wavelength; its RGB picture does not.
void read_buckets(Parameters& film, std::vector<std::string>& log) {
  film.integer("nbuckets", 16, "", "spectral channels; not written");
  film.number("lambdamin", 360.f, "nm", "of the first; not written");
  film.number("lambdamax", 830.f, "nm", "of the last; not written");
  log.push_back("film: light is carried as RGB: the spectral buckets are not used, the picture is");
}

}  // namespace

FilmDirective read_film(const SceneDescription& scene, const BuildOptions& options,
                        std::vector<std::string>& log) {
  const std::string type = scene.film.given() ? scene.film.type : "rgb";
  if (type != "rgb" && type != "gbuffer" && type != "spectral") {
    throw Error(scene.film.where, "film \"" + type + "\" is unknown or not supported yet");
  }
  Parameters film(scene.film.parameters, scene.film.where, "film \"" + type + "\"", nullptr);
  FilmDirective settings;
  if (type == "gbuffer") read_layers(film, settings);
  if (type == "spectral") read_buckets(film, log);
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
  const auto [open, close] = shutter_times(scene.camera);
  settings.sensor = read_sensor(film, close - open, log);
  read_output(film, settings, log);
  if (!options.honour_clamp) settings.max_component = infinity;
  film.check_all_read();
  if (scene.color_space != "srgb") {
    log.push_back("film: the picture is written in linear Rec.709, not in \"" + scene.color_space +
                  "\"");
  }
  return settings;
}

// The camera checks the parameters' types.
std::array<float, 2> shutter_times(const Directive& camera) {
  float open = 0.f, close = 1.f;
  for (const Parameter& p : camera.parameters) {
    if (p.floats.size() != 1) continue;
    if (p.name == "shutteropen") open = p.floats[0];
    if (p.name == "shutterclose") close = p.floats[0];
  }
  if (!(close > open)) throw Error(camera.where, "the camera's shutter closes before it opens");
  return {open, close};
}

std::shared_ptr<const RasterMap> make_raster_map(const RasterFrame& frame,
                                                 std::shared_ptr<const Filter> filter,
                                                 const Parameters& parameters) {
  try {
    return std::make_shared<const RasterMap>(frame, std::move(filter));
  } catch (const Error& e) {
    parameters.fail(e.what());
  }
}

}  // namespace pssmlt
