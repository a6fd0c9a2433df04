#include "app/stress/catalogue.h"
namespace pssmlt::stress {
void add_media_cases(Cases&) {}
}  // namespace pssmlt::stress
