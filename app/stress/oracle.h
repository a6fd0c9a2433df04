// Decides by statistics, or bit by bit, whether a picture is what it must be.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/stress/picture.h"

namespace pssmlt::stress {

// How far apart the worst block is.
struct Comparison {
  double deviation = 0.0;  // largest over the blocks, relative to what is expected
  double tolerance = 0.0;  // of that block
  double widest = 0.0;  // the whole's tolerance, or a fifth of the widest block's if that is more
  bool holds = false;   // every block is within its own tolerance
  std::string where;    // "block 3", "the whole"
};

// |t| of Student's t that is exceeded with probability p, two-sided, with n degrees of freedom.
double student_limit(double p, double n);

// Two-sided t-test of each block's groups against a known value. false_alarm: of one block.
// `rounding`: relative difference that does not count.
Comparison compare_means(const Blocks& blocks, std::span<const double> expected, double rounding,
                         double false_alarm);
// Welch's test of `blocks` against factor times `reference`, with the degrees of freedom of the
// smaller side, which is on the safe side.
Comparison compare_blocks(const Blocks& blocks, const Blocks& reference, double factor,
                          double rounding, double false_alarm);
// The whole against an upper limit, one-sided, and against negative values.
Comparison compare_limit(const Blocks& blocks, double most, double false_alarm);
// Bit by bit: tolerance 0. Pictures of different sizes never agree.
Comparison compare_bits(const Image& image, const Image& reference, double factor);

// True if there is no light at all: nothing follows from two such pictures being alike.
bool is_black(const Blocks& blocks);
// "5 blocks of 32 groups: t-test, false alarm 1e-11 each"
std::string meaning_of(const Blocks& blocks, double false_alarm);

}  // namespace pssmlt::stress
