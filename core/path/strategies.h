// Path expressions of the strategies that integrators are made of. An integrator composes sees()
// from the strategies that it uses, so that the code and its mask stay together.
#pragma once

#include <initializer_list>
#include <string>

namespace pssmlt::strategy {

// A camera path meets a light that can be hit, or passes through one (s = 0).
inline constexpr const char* hit_light = "(A|I|V).*E";
// A connectible vertex of the camera path draws a point on a light (s = 1).
inline constexpr const char* next_event = "(A|I|P)D.*E";
// Two connectible vertices are joined (s, t >= 2).
inline constexpr const char* join = "(A|I|P).*DD.*E";
// A connectible vertex of a light path draws a point on the lens (t = 1).
inline constexpr const char* lens = "(A|I|P).*DE";
// The lens seen from a point of a finite light (s = t = 1).
inline constexpr const char* light_to_lens = "AE";
// A light drawn for a point of the camera itself, where that is a bare surface (s = t = 1).
inline constexpr const char* sensor_draw = "(A|I|P)E";
// The same of lights that have no size.
inline constexpr const char* sensor_draw_delta = "PE";
// The first two along specular chains only.
inline constexpr const char* specular_hit = "(A|I|V)S*E";
inline constexpr const char* specular_next_event = "(A|I|P)DS*E";

// Paths that any of the strategies finds.
inline std::string any_of(std::initializer_list<const char*> strategies) {
  std::string out;
  for (const char* s : strategies) out += (out.empty() ? "" : "|") + std::string(s);
  return out;
}

}  // namespace pssmlt::strategy
