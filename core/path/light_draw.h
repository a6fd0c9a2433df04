// One point on one light, drawn for a reference point: what next event estimation starts from.
#pragma once

#include <optional>

#include "core/path/numbers.h"
#include "core/path/path_expression.h"
#include "core/scene/scene.h"

namespace pssmlt {

class LightDraw {
 public:
  LightDraw(const Scene& scene, const vec3& reference, const LightNumbers& u)
      : choice_(scene.lights().choose(u.choice)),
        toward_(choice_.light ? choice_.light->toward(reference, u.position) : std::nullopt) {
    if (toward_) traits_ = choice_.light->traits();
  }
  LightDraw(const LightDraw&) = delete;
  LightDraw& operator=(const LightDraw&) = delete;

  // False where no light reaches the reference; nothing else may be asked for then.
  bool succeeded() const {
    return toward_ && !is_black(toward_->value) && toward_->pdf_toward > 0.f;
  }
  const Toward& toward() const { return *toward_; }
  // Density of the whole draw [1/sr at the reference; see Toward::pdf_toward].
  float pdf() const { return choice_.probability * toward_->pdf_toward; }
  bool delta() const { return traits_.delta_position || traits_.delta_direction; }
  LightLetter letter() const { return light_letter(traits_); }

 private:
  LightTable::Choice choice_;
  std::optional<Toward> toward_;  // made in place: it is large
  EndpointTraits traits_;
};

}  // namespace pssmlt
