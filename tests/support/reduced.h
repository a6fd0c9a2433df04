// Builds with sanitizers run many times slower, and find nothing in the thousandth sample that is
// not in the first: tests of pictures by statistics leave themselves out there.
#pragma once

#include <cstdlib>

namespace pssmlt::test {

inline bool reduced() { return std::getenv("PSSMLT_TEST_REDUCED") != nullptr; }

}  // namespace pssmlt::test
