// Points of primary sample space as text, so that a sample can be evaluated again bit for bit.
#pragma once

#include <string>
#include <string_view>

#include "core/sampling/primary_sample_owner.h"

namespace pssmlt {

// "u:" and for every block held "<stream>.<block index>=<4 x 8 hex digits>", joined by commas.
std::string numbers_to_text(const PrimarySample& u);
// Makes `owner` show the point that the text describes; numbers it does not name are 0. False if
// the text is not of that form (owner is then at an unspecified point).
bool numbers_from_text(std::string_view text, PrimarySampleOwner& owner);
// The parts of "<name>:<seed>:<pixel>:<index>".
struct SampleName {
  std::string name;
  uint64_t seed = 0;
  int64_t pixel = 0, index = 0;
};
// False if the text is not of that form.
bool parse_sample_name(std::string_view text, SampleName& name);

}  // namespace pssmlt
