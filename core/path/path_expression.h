// Light path expressions (Heckbert 1990): regular expressions over the vertices of a path from the
// light to the camera, to select path classes.
//
//   A finite area light   I environment   P delta light (point, spot, distant)
//   V a medium that emits (volume)   L any of these
//   D scattering by a connectible lobe    S by a delta lobe    . either          E camera
//   ( ) | * + ?  as usual;  & of whole expressions: both must accept
//
// "L.*E" is everything, "LS*E" light seen directly or through mirrors, "LS+DS*E" caustics.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/endpoint.h"
#include "core/scene/parameters.h"

namespace pssmlt {

enum class LightLetter : uint8_t { area, infinite, delta, medium };
inline constexpr LightLetter light_letters[] = {LightLetter::area, LightLetter::infinite,
                                                LightLetter::delta, LightLetter::medium};

// The letter of a light with these traits.
inline LightLetter light_letter(const EndpointTraits& traits) {
  if (!traits.hittable()) return LightLetter::delta;
  return traits.infinite ? LightLetter::infinite : LightLetter::area;
}

// Deterministic automata in both directions, so that a path built from both ends is matched with
// one table look-up per vertex and one per connection.
class PathExpression {
 public:
  PathExpression() : PathExpression("L.*E") {}
  // Throws Error at `where` with the place of the fault inside the expression.
  explicit PathExpression(std::string_view text, const Location& where = {});

  using State = uint16_t;
  // State after the light's letter, reading from the light.
  State from_light(LightLetter light) const { return light_start_[static_cast<size_t>(light)]; }
  // State after E, reading from the camera.
  State from_camera() const { return camera_start_; }
  State light_step(State s, bool delta) const { return light_step_[s * 2u + (delta ? 1u : 0u)]; }
  State camera_step(State s, bool delta) const { return camera_step_[s * 2u + (delta ? 1u : 0u)]; }
  // Does the path "light side, then camera side" match? Each vertex is on exactly one side.
  bool joins(State light_side, State camera_side) const {
    return joins_[light_side * camera_states_ + camera_side] != 0;
  }
  // Same for a camera path that ends on a light of this kind (s = 0).
  bool ends(LightLetter light, State camera_side) const {
    return joins(from_light(light), camera_side);
  }
  // True if no path that goes on from this state can match.
  bool camera_dead(State s) const { return s == camera_dead_; }
  bool light_dead(State s) const { return s == light_dead_; }
  bool accepts_all() const { return accepts_all_; }
  // True if no path of up to `bounces` scattering vertices over the given letters matches both
  // expressions: used to compute what an integrator cannot see in a scene.
  static bool disjoint(const PathExpression& a, const PathExpression& b,
                       const struct SceneFeatures& scene, int min_bounces, int max_bounces);
  bool matches(std::string_view path) const;  // e.g. "ASDE"
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  // Indexed by state; two entries a state (connectible, delta) for the steps.
  std::vector<State> light_step_, camera_step_;
  std::vector<uint8_t> joins_;
  State light_start_[4] = {0, 0, 0, 0};
  State camera_start_ = 0;
  State light_dead_ = 0, camera_dead_ = 0;
  uint32_t camera_states_ = 1;
  bool accepts_all_ = true;

  friend class PathAutomaton;  // path_expression.cpp: builds the tables
};

// The limits that every integrator takes: "mindepth" (0), "maxdepth" (5), "paths" ("L.*E").
class PathLimits {
 public:
  PathLimits() = default;
  explicit PathLimits(Parameters& parameters);
  int min_bounces = 0;
  int max_bounces = 5;  // scattering vertices, as pbrt counts
  PathExpression paths;
  bool in_range(int bounces) const { return bounces >= min_bounces && bounces <= max_bounces; }
};

}  // namespace pssmlt
