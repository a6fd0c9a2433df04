#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_fault_cases(Cases&) {}
}  // namespace pssmlt::stress
