// The common face of lights and cameras: the two ends of every path. Bidirectional code is written
// once against it. "Value" is emitted radiance for a light, importance for a camera; importance is
// normalised so that the whole image measures 1: a ray sampled by emit() has weight 1.
//
// Formal densities of degenerate endpoints keep the algebra free of special cases: an endpoint with
// a delta position has pdf_position = 1 and carries intensity [W/sr] as value; one with a delta
// direction has pdf_direction = 1 and carries irradiance [W/m^2]. The flags say so; no ratio is
// ever formed with a zero or an infinity.
#pragma once

#include <optional>

#include "core/base/rgb.h"
#include "core/plugin/plugin_name.h"

namespace pssmlt {

struct EndpointTraits {
  bool delta_position = false;   // point, spot, pinhole camera
  bool delta_direction = false;  // distant light
  bool infinite = false;         // at infinity: distant, environment
  bool hidden = false;           // rays pass through it: an area light whose shape is cut out
  // False if rays never meet it, so that only connections and emission find it.
  bool hittable() const { return !delta_position && !delta_direction && !hidden; }
};

// A point on an endpoint. Infinite lights have no position; they use the direction toward them.
struct EndpointPoint {
  vec3 position{0.f};  // [m]
  vec3 normal{0.f};    // unit; zero for delta positions
  vec2 uv{0.f};
  uint32_t element = 0;
};

// A ray that leaves the endpoint.
struct Emission {
  EndpointPoint from;
  vec3 error{0.f};            // of the position [m]
  vec3 direction{0.f};        // unit, away from the endpoint
  Rgb value{0.f};             // [W/(m^2 sr)] or importance; see above for delta endpoints
  float cosine = 1.f;         // |normal . direction|; 1 for delta positions and infinite endpoints
  float pdf_position = 0.f;   // [1/m^2]; infinite: on the disk facing the scene
  float pdf_direction = 0.f;  // [1/sr]
  // Throughput of the ray: value * cosine / (pdf_position * pdf_direction).
  Rgb weight() const { return value * (cosine / (pdf_position * pdf_direction)); }
};

// A point of the endpoint as seen from a reference point, with what emit() would have to say of
// the ray that leaves it toward the reference.
struct Toward {
  EndpointPoint at;
  vec3 error{0.f};            // of at.position [m]
  vec3 wi{0.f};               // unit, from the reference to the endpoint
  float distance = 0.f;       // [m]; infinity for infinite endpoints
  Rgb value{0.f};             // emitted from the endpoint toward the reference
  float pdf_toward = 0.f;     // [1/sr] at the reference; delta position: distance^2, direction: 1
  float cosine = 1.f;         // at the endpoint, as in Emission
  float pdf_position = 0.f;   // [1/m^2], of emit()
  float pdf_direction = 0.f;  // [1/sr], of emit()
  dvec2 raster{0.0};          // cameras: where the connection lands [pixels]
};

// Value and densities of emit() at a given point and direction.
struct EmissionValue {
  Rgb value{0.f};
  float cosine = 1.f;
  float pdf_position = 0.f;   // [1/m^2]
  float pdf_direction = 0.f;  // [1/sr]
};

class Endpoint : public PluginNamed {
 public:
  virtual ~Endpoint() = default;
  virtual EndpointTraits traits() const = 0;
  // Samples a leaving ray. u_position in [0,1)^2. u_direction: lights in [0,1)^2, cameras the
  // raster position [pixels]. nullopt where nothing is emitted.
  virtual std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const = 0;
  // Samples a point of the endpoint that may be seen from `reference`; nullopt where none can.
  virtual std::optional<Toward> toward(const vec3& reference, const vec2& u) const = 0;
  // Value, cosine and emit()'s densities of the ray leaving `at` along `direction` (unit, away
  // from the endpoint). value is 0 on the dark side or outside the picture.
  virtual EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const = 0;
  // Density [1/sr at the reference] with which toward(reference) finds `at`; infinite endpoints
  // get the direction toward them in at.normal (negated: normal = -wi). 0 if it can't.
  virtual float pdf_toward(const vec3& reference, const EndpointPoint& at) const = 0;
};

}  // namespace pssmlt
