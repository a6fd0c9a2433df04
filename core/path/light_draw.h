// One point on one light, drawn for a reference point: what next event estimation starts from.
#pragma once

#include <optional>

#include "core/path/numbers.h"
#include "core/path/path_expression.h"
#include "core/scene/scene.h"

namespace pssmlt {

struct LightDraw {
  const Light* light = nullptr;
  float probability = 0.f;  // of choosing this light [1]
  EndpointTraits traits;
  Toward toward;
  // Density of the whole draw [1/sr at the reference; see Toward::pdf_toward].
  float pdf() const { return probability * toward.pdf_toward; }
  bool delta() const { return traits.delta_position || traits.delta_direction; }
  LightLetter letter() const { return light_letter(traits); }
};

// nullopt where no light reaches the reference.
inline std::optional<LightDraw> draw_light(const Scene& scene, const vec3& reference,
                                           const LightNumbers& u) {
  const auto choice = scene.lights().choose(u.choice);
  if (!choice.light) return std::nullopt;
  const auto toward = choice.light->toward(reference, u.position);
  if (!toward || is_black(toward->value) || !(toward->pdf_toward > 0.f)) return std::nullopt;
  return LightDraw{choice.light, choice.probability, choice.light->traits(), *toward};
}

}  // namespace pssmlt
