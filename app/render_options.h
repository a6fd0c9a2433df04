// What the user asks `pssmlt render` for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/live/render_view.h"
#include "core/render/render.h"

namespace pssmlt {

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;  // empty: the film's filename
  BuildOptions build;
  RenderSettings render;
  ViewOptions view_while;  // who watches while it renders
  std::optional<uint64_t> seed;
  uint64_t texture_cache = 0;  // limit of the textures' memory [bytes]; 0: none
  bool quiet = false, verbose = false;
  std::string json;  // file for the statistics; "": none
  std::string view;  // OpenColorIO view for 8-bit images
  std::vector<std::string> auxiliary;
  std::optional<ivec2> pixel;      // print the paths of this pixel
  std::string replay;              // print this sample
  std::vector<std::string> notes;  // for the log, e.g. that a bare number was taken as seconds
};

// Throws Error on bad usage. nullopt: help was printed.
std::optional<RenderOptions> parse_render_options(const Arguments& arguments);

// "90s", "1.5m", "2h", "250ms"; a bare number is seconds, which is said in `notes`. Throws Error.
double parse_duration(const std::string& text, std::vector<std::string>& notes);

}  // namespace pssmlt
