// Light drawn for the camera's own point (s = t = 1), where the camera is a bare surface
// (Camera::bare()): next event estimation before the first scattering.
#pragma once

#include "core/path/flight.h"
#include "core/path/light_draw.h"

namespace pssmlt {

// The camera's point as a receiver of light.
inline LightReceiver sensor_receiver(const Emission& start) {
  return {.position = start.from.position, .normal = start.from.normal};
}

class SensorDraw {
 public:
  // `start`: a ray of the camera, whose point is taken and whose direction is not.
  SensorDraw(const Scene& scene, LightPick pick, const Emission& start, float time,
             const LightNumbers& u)
      : scene_(scene), start_(start), time_(time), draw_(scene, pick, sensor_receiver(start), u) {
    if (draw_.succeeded()) cosine_ = glm::dot(start.from.normal, draw_.toward().wi);
  }
  // False where no light reaches the point; nothing else may be asked for then.
  bool succeeded() const { return cosine_ > 0.f; }
  LightLetter letter() const { return draw_.letter(); }
  // Irradiance [W/m^2] if nothing stands between.
  Rgb value() const {
    return start_.value * draw_.toward().value * (cosine_ / (start_.pdf_position * draw_.pdf()));
  }
  // What the light passes on its way.
  Passage way() const {
    const Toward& t = draw_.toward();
    const vec3& from = start_.from.position;
    Ray ray{offset_origin(from, start_.error, start_.from.normal, t.wi), t.wi, infinity, time_};
    if (t.distance < infinity)
      ray = Scene::segment(from, start_.error, start_.from.normal, t.at.position, t.error,
                           t.at.normal, time_);
    return passage(scene_, ray, scene_.camera_medium());
  }
  // Density [1/sr] of the draw, and with which a ray of the camera meets the same point: 0 if it
  // cannot.
  float pdf() const { return draw_.pdf(); }
  float met() const {
    return draw_.hittable() ? start_.pdf_direction * cosine_ / start_.cosine : 0.f;
  }

 private:
  const Scene& scene_;
  const Emission& start_;
  float time_;
  LightDraw draw_;
  float cosine_ = 0.f;
};

}  // namespace pssmlt
