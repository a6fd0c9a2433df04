#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_geometry_cases(Cases&) {}
}  // namespace pssmlt::stress
