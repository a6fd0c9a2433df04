#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_metropolis_cases(Cases&) {}
}  // namespace pssmlt::stress
