// Lens systems as photographic lenses are made: spherical surfaces and stops along one axis, traced
// in double, without dispersion and without the light that surfaces reflect.
//
// Source: Kolb, Mitchell and Hanrahan 1995, "A Realistic Camera Model for Computer Graphics";
// Pharr, Jakob and Humphreys 2016, Physically Based Rendering, third edition, section 6.4. In the
// space of the system the film lies in the plane z = 0 around the axis, which is z, and the scene
// toward +z.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/lens/aperture.h"

namespace pssmlt {

struct LensSurface {
  double radius = 0.0;   // of curvature [m], positive: bulges toward the scene; 0: a stop
  double z = 0.0;        // where it meets the axis [m]
  double index = 1.0;    // refractive index of what lies on its side of the film
  double opening = 0.0;  // radius of its opening [m]
  bool is_stop() const { return radius == 0.0; }
};

struct LensRay {
  dvec3 origin{0.0}, direction{0.0};  // direction: unit
  dvec3 at_height(double z) const { return origin + direction * ((z - origin.z) / direction.z); }
};

// A thick lens that does to rays near the axis what the system does.
struct ThickLens {
  double focal_length = 0.0;                   // [m]; infinite: no power
  double scene_plane = 0.0, film_plane = 0.0;  // z of the principal planes [m]
};

class LensSystem {
 public:
  // From the scene to the film, with `film_distance` [m] from the last surface to the film, which
  // lies in air. `openings`: what stops let through.
  LensSystem(std::vector<LensSurface> surfaces, double film_distance, Aperture openings);

  // Follows a ray through all surfaces; it then starts on the last of them. Returns what the stops
  // let through [1], 0 where the ray is blocked or totally reflected.
  double from_film(LensRay& ray) const;
  double from_scene(LensRay& ray) const;

  ThickLens thick_lens() const;
  // Moves the film so that the plane at `distance` [m] from it is in focus for the thick lens.
  // False if no position does that: the plane is nearer than four focal lengths, the system has no
  // positive power, or its last surface would not stay in front of the film.
  bool focus(double distance);
  // The same with stops that are round and let through all that these let through anywhere.
  LensSystem with_round_stops() const;

  const LensSurface& front() const { return surfaces_.front(); }
  const LensSurface& rear() const { return surfaces_.back(); }
  // A plane in front of the whole first surface [m].
  double front_plane() const;

 private:
  double index_before(size_t i) const { return i == 0 ? 1.0 : surfaces_[i - 1].index; }
  double pass(const LensSurface& s, double eta, LensRay& ray) const;
  std::vector<LensSurface> surfaces_;  // from the scene to the film
  Aperture aperture_;
};

// The surfaces of a lens file: a row of four numbers each from the scene to the film, radius of
// curvature [mm], distance to the next surface or to the film [mm], refractive index behind it (0:
// air), diameter of its opening [mm]; # starts a comment. Throws Error at the place in the file.
struct LensFile {
  std::vector<LensSurface> surfaces;
  double film_distance = 0.0;  // [m], unfocused
  bool has_stop = false;
};
LensFile read_lens_file(const std::string& path);

}  // namespace pssmlt
