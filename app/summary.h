// The summary at the end of a render, from its statistics.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pssmlt {

// Several lines without the last line break. `statistics` as in RenderResult, with what
// `pssmlt render --json` adds.
std::string summary_text(const nlohmann::json& statistics);

}  // namespace pssmlt
