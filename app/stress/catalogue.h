// All cases. Each group of the catalogue has a file in app/stress/catalogue.
#pragma once

#include <vector>

#include "app/stress/case.h"

namespace pssmlt::stress {

using Cases = std::vector<Case>;

void add_scale_cases(Cases& cases);        // 1: lengths and translations
void add_radiometric_cases(Cases& cases);  // 2: radiance
void add_light_cases(Cases& cases);        // 3: sizes and numbers of lights
void add_roughness_cases(Cases& cases);    // 4: from rough to smooth
void add_refraction_cases(Cases& cases);   // 5: indices of refraction
void add_albedo_cases(Cases& cases);       // 6: white walls, long paths
void add_media_cases(Cases& cases);        // 7: thick and thin media
void add_geometry_cases(Cases& cases);     // 8: slivers, normals, instances
void add_camera_cases(Cases& cases);       // 9: fields of view, lenses, sizes
void add_metropolis_cases(Cases& cases);   // 10: chains
void add_fault_cases(Cases& cases);        // 11: plugins and machines that fail

// In the order of the groups.
Cases catalogue();

}  // namespace pssmlt::stress
