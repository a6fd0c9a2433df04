// Path expressions of the strategies that integrators are made of. An integrator composes sees()
// from the strategies that it uses, so that the code and its mask stay together.
#pragma once

#include <initializer_list>
#include <string>

namespace pssmlt::strategy {

// A camera path meets a light that can be hit (s = 0).
inline constexpr const char* hit_light = "(A|I).*E";
// A connectible vertex of the camera path draws a point on a light (s = 1).
inline constexpr const char* next_event = "LD.*E";
// Two connectible vertices are joined (s, t >= 2).
inline constexpr const char* join = "L.*DD.*E";
// A connectible vertex of a light path draws a point on the lens (t = 1).
inline constexpr const char* lens = "L.*DE";
// The lens seen from a point of a finite light (s = t = 1).
inline constexpr const char* light_to_lens = "AE";
// The first two along specular chains only.
inline constexpr const char* specular_hit = "(A|I)S*E";
inline constexpr const char* specular_next_event = "LDS*E";

// Paths that any of the strategies finds.
inline std::string any_of(std::initializer_list<const char*> strategies) {
  std::string out;
  for (const char* s : strategies) out += (out.empty() ? "" : "|") + std::string(s);
  return out;
}

}  // namespace pssmlt::strategy
