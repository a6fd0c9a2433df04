// v3's film, filters, cameras, samplers and integrators.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/dialect/translation.h"

namespace pssmlt::v3 {
namespace {

// Samplers that only v3 had, and parameters of samplers that are not there any more.
constexpr std::array<std::string_view, 4> old_samplers = {"lowdiscrepancy", "maxmindist",
                                                          "02sequence", "zerotwosequence"};
constexpr std::array<std::string_view, 3> dead_sampler_parameters = {
    "dimensions", "samplepixelcenter", "scramble"};

float number_or(const ParameterSet& set, std::string_view name, float fallback) {
  for (const Parameter& p : set)
    if (p.name == name && p.type == ParameterType::Float && p.floats.size() == 1)
      return p.floats[0];
  return fallback;
}

// v3's film does not know how long the shutter is open: the film's speed undoes it.
void translate_film(Translation& t) {
  Directive& film = t.scene.film;
  if (film.type == "image") {
    film.type = "rgb";
    t.translated("film", "image");
  } else if (!t.old || film.given()) {
    return;  // today's
  }
  if (Parameter* const file = find(film.parameters, "filename")) {
    for (std::string& name : file->strings) {
      if (!name.ends_with(".tga")) continue;
      name.replace(name.size() - 4, 4, ".png");
      t.dropped("output as tga (png instead)");
    }
  }
  const float scale = take_number(film.parameters, "scale", 1.f);
  if (take(film.parameters, "maxsampleluminance")) t.dropped("maxsampleluminance of the film");
  ParameterSet& camera = t.scene.camera.parameters;
  const float open = number_or(camera, "shutteropen", 0.f);
  float shutter = number_or(camera, "shutterclose", 1.f) - open;
  if (shutter <= 0.f) {  // v3 renders an instant
    put(camera, number("shutterclose", open + 1.f, t.scene.camera.where));
    shutter = 1.f;
  }
  if (scale == 1.f && shutter == 1.f) return;
  if (film.type.empty()) film.type = "rgb";
  put(film.parameters, number("iso", 100.f * scale / shutter, film.where));
}

void translate_filter(Translation& t) {
  Directive& filter = t.scene.filter;
  if (!filter.given()) {
    if (!t.old) return;
    filter.type = "box";  // v3's default
    return;
  }
  ParameterSet& set = filter.parameters;
  const bool old_names = has(set, "xwidth") || has(set, "ywidth") || has(set, "alpha");
  if (!old_names && !t.old) return;
  const bool gaussian = filter.type == "gaussian";
  if (old_names || gaussian) t.translated("filter", filter.type);
  for (const auto& [from, to] : {std::pair{"xwidth", "xradius"}, std::pair{"ywidth", "yradius"}}) {
    if (has(set, from))
      rename(set, from, to);
    else if (gaussian && !has(set, to))
      put(set, number(to, 2.f, filter.where));
  }
  const float alpha = take_number(set, "alpha", 2.f);
  if (!gaussian || has(set, "sigma")) return;
  if (!(alpha > 0.f))
    throw Error(filter.where, "\"alpha\" of the gaussian filter must be positive");
  put(set, number("sigma", 1.f / std::sqrt(2.f * alpha), filter.where));
}

void translate_camera(Translation& t) {
  Directive& camera = t.scene.camera;
  ParameterSet& set = camera.parameters;
  if (camera.type == "environment") {
    camera.type = "spherical";
    put(set, text("mapping", {"equirectangular"}, camera.where));
    t.translated("camera", "environment");
  }
  if (const auto half = take(set, "halffov")) {
    if (half->floats.size() != 1) throw Error(half->where, "\"halffov\" must be one number");
    put(set, number("fov", 2.f * half->floats[0], half->where));
    t.translated("camera", camera.type);
  }
  if (t.old) take(set, "simpleweighting");
}

void translate_sampler(Translation& t, Directive& sampler) {
  if (std::ranges::find(old_samplers, sampler.type) != old_samplers.end()) {
    t.translated("sampler", sampler.type);
    sampler.type = "sobol";
  }
  if (!t.old) return;
  for (const std::string_view name : dead_sampler_parameters) take(sampler.parameters, name);
}

// v3 limited what is rendered by the integrator, today the film does.
void move_pixel_bounds(Translation& t, ParameterSet& integrator) {
  auto bounds = take(integrator, "pixelbounds");
  if (!bounds) return;
  if (t.scene.film.type.empty()) t.scene.film.type = "rgb";
  put(t.scene.film.parameters, std::move(*bounds));
}

void translate_sppm(Translation& t, Directive& integrator, Directive& sampler) {
  ParameterSet& set = integrator.parameters;
  take(set, "imagewritefrequency");
  const int given = take_integer(set, "numiterations", -1);
  const int iterations = take_integer(set, "iterations", given);
  if (iterations <= 0) return;
  t.translated("integrator", "sppm");
  if (sampler.type.empty()) sampler.type = "halton";
  put(sampler.parameters, integer("pixelsamples", iterations, integrator.where));
}

void translate_integrator(Translation& t, Directive& integrator, Directive& sampler) {
  ParameterSet& set = integrator.parameters;
  if (integrator.type == "ao" || integrator.type == "ambientocclusion") {
    throw Error(integrator.where, "integrator \"" + integrator.type +
                                      "\" has no counterpart here: it renders no light transport");
  }
  if (integrator.type == "directlighting") {
    integrator.type = "whitted";
    take(set, "strategy");
    t.translated("integrator", "directlighting");
  }
  if (integrator.type == "sppm" && t.old) translate_sppm(t, integrator, sampler);
  if (take(set, "rrthreshold")) t.translated("integrator", integrator.type);
  if (const auto strategy = take(set, "lightsamplestrategy")) {
    t.translated("integrator", integrator.type);
    const bool path = integrator.type == "path" || integrator.type == "volpath";
    if (path && strategy->strings.size() == 1) {
      const std::string& name = strategy->strings[0];
      put(set, text("lightsampler", {name == "spatial" ? "bvh" : name}, strategy->where));
    }
  }
  if (t.old) move_pixel_bounds(t, set);
}

}  // namespace

bool has_old_names(const SceneDescription& s) {
  const auto old_sampler = [](const LayerDescription& layer) {
    return std::ranges::find(old_samplers, layer.sampler.type) != old_samplers.end();
  };
  const auto old_integrator = [](const LayerDescription& layer) {
    return layer.integrator.type == "directlighting";
  };
  const auto with = [](std::string_view name) {
    return [name](const Directive& d) { return has(d.parameters, name); };
  };
  return s.film.type == "image" || s.camera.type == "environment" ||
         std::ranges::any_of(s.layers, old_sampler) ||
         std::ranges::any_of(s.layers, old_integrator) ||
         std::ranges::any_of(s.materials, [](const auto& m) { return is_old_material(m.type); }) ||
         std::ranges::any_of(s.materials, with("bumpmap")) ||
         std::ranges::any_of(s.materials, with("namedmaterial1")) ||
         std::ranges::any_of(s.lights, with("mapname")) ||
         std::ranges::any_of(s.area_lights, with("nsamples"));
}

void translate_options(Translation& t) {
  for (LayerDescription& layer : t.scene.layers) {
    translate_integrator(t, layer.integrator, layer.sampler);
    translate_sampler(t, layer.sampler);
  }
  translate_camera(t);
  translate_film(t);
  translate_filter(t);
}

}  // namespace pssmlt::v3
