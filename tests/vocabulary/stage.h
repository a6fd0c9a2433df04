// Small scenes (tests/vocabulary/stages) on which the effect of a word can be seen.
#pragma once

#include <string>

#include "tests/vocabulary/vocabulary.h"

namespace pssmlt::test {

// The two scenes whose pictures a word must tell apart: with it, and with what stands instead (the
// word's base; else nothing, or the plugin without the parameter).
struct StagedScenes {
  std::string with, without;
};

// Throws if there is no stage for the word.
StagedScenes staged(const Word& word);

}  // namespace pssmlt::test
