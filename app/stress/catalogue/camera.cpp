#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_camera_cases(Cases&) {}
}  // namespace pssmlt::stress
