#include "core/texture_mapping.h"

#include <algorithm>
#include <array>

#include <glm/trigonometric.hpp>

#include "core/base/frame.h"
#include "core/vertex_data.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> kind_names = {"uv", "spherical", "cylindrical", "planar"};

// A step across the seam of a coordinate of period 1 is a short one.
float unwrapped(float step) { return step - std::round(step); }

}  // namespace

TextureMapping2D::Kind TextureMapping2D::read_kind(Parameters& p) {
  const std::string name = p.choice("mapping", "uv", kind_names, "source of the coordinates");
  const auto at = std::ranges::find(kind_names, name) - kind_names.begin();
  return static_cast<Kind>(at);
}

TextureMapping2D::TextureMapping2D(Parameters& p)
    : kind_(read_kind(p)), to_texture_(p.transform().inverse()) {
  const bool all = p.describing();
  if (kind_ == Kind::uv || all) {
    scale_.x = p.number("uscale", 1.f, "", "uv: factor of u");
    scale_.y = p.number("vscale", 1.f, "", "uv: factor of v");
    const float turn = p.number("uvrotation", 0.f, "degrees",
                                "uv: turn about (0, 0), counter-clockwise, after the factors");
    const int set = p.integer("uvset", 0, "", "uv: 1 for the mesh's second set of coordinates");
    if (set != 0 && set != 1) p.fail("uvset", "\"uvset\" must be 0 or 1");
    second_ = set == 1;
    if (turn != 0.f) {
      cosine_ = std::cos(glm::radians(turn));
      sine_ = std::sin(glm::radians(turn));
    }
  }
  if (kind_ == Kind::uv || kind_ == Kind::planar || all) {
    delta_.x = p.number("udelta", 0.f, "", "uv, planar: added to s");
    delta_.y = p.number("vdelta", 0.f, "", "uv, planar: added to t");
  }
  if (kind_ == Kind::planar || all) {
    v1_ = p.vector("v1", v1_, "planar: s is the position's component along it");
    v2_ = p.vector("v2", v2_, "planar: t is the position's component along it");
  }
}

vec2 TextureMapping2D::map_point(const vec3& p) const {
  switch (kind_) {
    case Kind::spherical: {
      const float cosine = p.z / glm::length(p);
      const float phi = std::atan2(p.y, p.x);
      return {std::acos(std::clamp(cosine, -1.f, 1.f)) * inv_pi,
              (phi < 0.f ? phi + 2.f * pi : phi) * (0.5f * inv_pi)};
    }
    case Kind::cylindrical:
      return {(pi + std::atan2(p.y, p.x)) * (0.5f * inv_pi), p.z};
    case Kind::planar:
      return delta_ + vec2(glm::dot(p, v1_), glm::dot(p, v2_));
    case Kind::uv:
      break;
  }
  return vec2(0.f);
}

vec2 TextureMapping2D::map(const Hit& hit) const {
  if (kind_ == Kind::uv) return rotated(scale_ * (second_ ? second_uv(hit) : hit.uv)) + delta_;
  return map_point(to_texture_.point(hit.position));
}

TextureFootprint TextureMapping2D::uv_footprint(const Hit& hit, const vec3& along,
                                                const vec3& across) const {
  // Least squares for a dpdu + b dpdv = direction, exact in the tangent plane.
  const float uu = length_squared(hit.dpdu), vv = length_squared(hit.dpdv);
  const float uv = glm::dot(hit.dpdu, hit.dpdv);
  const float determinant = uu * vv - uv * uv;
  if (!(determinant > 0.f) || second_) return {};
  const auto solve = [&](const vec3& direction) {
    const float u = glm::dot(hit.dpdu, direction), v = glm::dot(hit.dpdv, direction);
    return rotated(scale_ * vec2(vv * u - uv * v, uu * v - uv * u) / determinant);
  };
  return {solve(along), solve(across)};
}

TextureFootprint TextureMapping2D::footprint(const Hit& hit) const {
  if (!(hit.footprint > 0.f)) return {};
  const Frame frame = Frame::from_tangent(hit.ng, hit.dpdu);
  const vec3 along = frame.s * hit.footprint, across = frame.t * hit.footprint;
  if (kind_ == Kind::uv) return uv_footprint(hit, along, across);
  const vec2 here = map(hit);
  const auto step = [&](const vec3& direction) {
    vec2 d = map_point(to_texture_.point(hit.position + direction)) - here;
    if (kind_ == Kind::spherical) d.y = unwrapped(d.y);
    if (kind_ == Kind::cylindrical) d.x = unwrapped(d.x);
    return d;
  };
  return {step(along), step(across)};
}

float TextureMapping3D::footprint(const Hit& hit) const {
  if (!(hit.footprint > 0.f)) return 0.f;
  const Frame frame = Frame::from_tangent(hit.ng, hit.dpdu);
  const auto step = [&](const vec3& direction) {
    return glm::length(to_texture_.vector(hit.footprint * direction));
  };
  return std::max(step(frame.s), step(frame.t));
}

}  // namespace pssmlt
