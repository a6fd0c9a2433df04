// The page of the results, in the style of the comparison report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pssmlt::stress {

// index.html for what result_data() returned: opens from disk, without a network.
std::string report_page(const nlohmann::json& data);

}  // namespace pssmlt::stress
