// v3's shapes and media.
#include <algorithm>
#include <array>

#include "app/dialect/translation.h"

namespace pssmlt::v3 {
namespace {

constexpr std::array<std::string_view, 4> lost_shapes = {"cone", "hyperboloid", "nurbs",
                                                         "paraboloid"};

// Texture coordinates were also "st", and numbers without a type of their own.
bool translate_coordinates(ParameterSet& set) {
  bool changed = false;
  if (auto st = take(set, "st")) {
    if (!has(set, "uv")) put(set, renamed(std::move(*st), "uv"));
    changed = true;
  }
  if (Parameter* const uv = find(set, "uv"); uv != nullptr && uv->type == ParameterType::Float) {
    if (uv->floats.size() % 2 != 0)
      throw Error(uv->where, "\"uv\" must have an even number of values");
    uv->type = ParameterType::Point2;
    changed = true;
  }
  return changed;
}

// A grid of heights over the unit square, as triangles.
void translate_heightfield(ShapeDescription& shape) {
  ParameterSet& set = shape.parameters;
  const int nu = take_integer(set, "nu", -1), nv = take_integer(set, "nv", -1);
  const auto heights = take(set, "Pz");
  if (nu < 2 || nv < 2 || !heights ||
      heights->floats.size() != static_cast<size_t>(nu) * static_cast<size_t>(nv))
    throw Error(shape.where,
                "shape \"heightfield\" needs \"nu\", \"nv\" of 2 or more and nu * nv "
                "values \"Pz\"");
  Parameter points, uv, indices;
  points = renamed(*heights, "P");
  points.type = ParameterType::Point3;
  points.floats.clear();
  uv = points;
  uv.name = "uv";
  uv.type = ParameterType::Point2;
  indices = integer("indices", 0, heights->where);
  indices.ints.clear();
  for (int y = 0; y < nv; ++y)
    for (int x = 0; x < nu; ++x) {
      const float s = static_cast<float>(x) / static_cast<float>(nu - 1);
      const float r = static_cast<float>(y) / static_cast<float>(nv - 1);
      const float z = heights->floats[static_cast<size_t>(y * nu + x)];
      points.floats.insert(points.floats.end(), {s, r, z});
      uv.floats.insert(uv.floats.end(), {s, r});
      if (x + 1 == nu || y + 1 == nv) continue;
      const int i = y * nu + x;
      indices.ints.insert(indices.ints.end(), {i, i + 1, i + nu + 1, i, i + nu + 1, i + nu});
    }
  shape.type = "trianglemesh";
  for (Parameter* p : {&indices, &points, &uv}) put(set, std::move(*p));
}

void add_opacity(Translation& t, ShapeDescription& shape) {
  const auto opacity = t.opacity.find(shape.material);
  if (opacity == t.opacity.end()) return;
  t.opacity_used.insert(opacity->first);
  if (has(shape.parameters, "alpha")) {
    t.dropped("opacity of uber on shapes with an alpha of their own");
  } else {
    put(shape.parameters, opacity->second);
  }
}

void translate_shape(Translation& t, ShapeDescription& shape) {
  ParameterSet& set = shape.parameters;
  if (std::ranges::find(lost_shapes, shape.type) != lost_shapes.end())
    throw Error(shape.where,
                "shape \"" + shape.type + "\" has no counterpart: pbrt-v4 dropped it; use a mesh");
  const std::string was = shape.type;
  bool changed = false;
  if (shape.type == "heightfield") {
    translate_heightfield(shape);
    changed = true;
  }
  if (shape.type == "loopsubdiv" && has(set, "nlevels")) {
    rename(set, "nlevels", "levels");
    changed = true;
  }
  if (shape.type == "trianglemesh") changed |= translate_coordinates(set);
  changed |= take(set, "discarddegenerateUVs").has_value();
  if (take(set, "shadowalpha")) t.dropped("shadowalpha of " + was);
  if (changed) t.translated("shape", was);
  add_opacity(t, shape);
}

// Values that v3 takes where today's plugin has others.
void put_unless_given(ParameterSet& set, Parameter p) {
  if (!has(set, p.name)) set.push_back(std::move(p));
}

}  // namespace

void translate_shapes(Translation& t) {
  for (ShapeDescription& shape : t.scene.shapes) translate_shape(t, shape);
  for (ObjectDescription& object : t.scene.objects)
    for (ShapeDescription& shape : object.shapes) translate_shape(t, shape);
  if (t.opacity_used.size() < t.opacity.size()) t.dropped("opacity of uber inside of mix");
}

void translate_media(Translation& t) {
  for (MediumDescription& medium : t.scene.media) {
    if (medium.type != "heterogeneous") continue;
    medium.type = "uniformgrid";
    t.translated("medium", "heterogeneous");
    if (has(medium.parameters, "preset")) continue;
    put_unless_given(medium.parameters,
                     colour("sigma_a", {0.0011f, 0.0024f, 0.014f}, medium.where));
    put_unless_given(medium.parameters, colour("sigma_s", {2.55f, 3.21f, 3.77f}, medium.where));
  }
}

}  // namespace pssmlt::v3
