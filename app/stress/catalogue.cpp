#include "app/stress/catalogue.h"

namespace pssmlt::stress {

Cases catalogue() {
  Cases cases;
  add_scale_cases(cases);
  add_radiometric_cases(cases);
  add_light_cases(cases);
  add_roughness_cases(cases);
  add_refraction_cases(cases);
  add_albedo_cases(cases);
  add_media_cases(cases);
  add_geometry_cases(cases);
  add_camera_cases(cases);
  add_metropolis_cases(cases);
  add_fault_cases(cases);
  return cases;
}

}  // namespace pssmlt::stress
