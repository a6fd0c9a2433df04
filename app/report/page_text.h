// The page as one text: its HTML with style sheets, scripts and chart library in their places.
#pragma once

#include <string>
#include <string_view>

namespace pssmlt {

const std::string& page_text();
// Stands in the text, once, where the data go (as JSON).
inline constexpr std::string_view page_data_mark = "@PSSMLT_REPORT_DATA@";

}  // namespace pssmlt
