// docs/vocabulary.md, made from what became of the words.
#pragma once

#include <string>
#include <vector>

#include "tests/vocabulary/reviewed.h"
#include "tests/vocabulary/vocabulary.h"

namespace pssmlt::test {

// Counts, and a table for each kind: fates[i] is what became of words[i].
std::string page(const std::vector<Word>& words, const std::vector<Fate>& fates,
                 const Reasons& reasons);

}  // namespace pssmlt::test
