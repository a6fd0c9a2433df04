// One point on one light, drawn for a reference point: what next event estimation starts from.
#pragma once

#include <optional>

#include "core/path/numbers.h"
#include "core/path/path_expression.h"
#include "core/path/surface.h"
#include "core/path/witness.h"
#include "core/scene/scene.h"

namespace pssmlt {

// The parameter of integrators that draw lights.
LightPick read_light_pick(Parameters& p);

// A shaded surface as a receiver of light: the normal on the side where the path is, which for
// surfaces that transmit nothing is the side of both its directions. Only the position where the
// pick asks for nothing else.
inline LightReceiver light_receiver(const Scene& scene, LightPick pick, const Surface& surface) {
  LightReceiver at{.position = surface.hit.position};
  if (!scene.lights().by_place(pick) || surface.in_medium()) return at;
  at.normal = surface.facing_normal();
  at.transmits = surface.hit.primitive->transmits;
  return at;
}

class LightDraw {
 public:
  LightDraw(const Scene& scene, LightPick pick, const LightReceiver& at, const LightNumbers& u)
      : choice_(scene.lights().choose(pick, at, u.choice)),
        toward_(choice_.light ? choice_.light->toward(at.position, u.position) : std::nullopt) {
    if (!toward_) return;
    traits_ = choice_.light->traits();
    if (Witness* const w = Witness::here()) [[unlikely]]
      w->look_at(toward_->value, *choice_.light);
  }
  LightDraw(const Scene& scene, LightPick pick, const Surface& surface, const LightNumbers& u)
      : LightDraw(scene, pick, light_receiver(scene, pick, surface), u) {}
  LightDraw(const LightDraw&) = delete;
  LightDraw& operator=(const LightDraw&) = delete;

  // False where no light reaches the reference; nothing else may be asked for then.
  bool succeeded() const {
    return toward_ && !is_black(toward_->value) && toward_->pdf_toward > 0.f;
  }
  const Toward& toward() const { return *toward_; }
  // Density of the whole draw [1/sr at the reference; see Toward::pdf_toward].
  float pdf() const { return choice_.probability * toward_->pdf_toward; }
  // Probability of choosing the light to emit, over that of having drawn it here.
  float emitted_over_drawn() const { return choice_.emission / choice_.probability; }
  bool hittable() const { return traits_.hittable(); }
  LightLetter letter() const { return light_letter(traits_); }

 private:
  LightTable::Choice choice_;
  std::optional<Toward> toward_;  // made in place: it is large
  EndpointTraits traits_;
};

}  // namespace pssmlt
