#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_light_cases(Cases&) {}
}  // namespace pssmlt::stress
