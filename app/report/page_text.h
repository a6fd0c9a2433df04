// The page's HTML, style sheets, scripts and chart library as one text, put together and compiled
// in by app/report/page.cmake.
#pragma once

#include <string_view>

namespace pssmlt {

std::string_view page_text();
// Stands in the text, once, where the data go (as JSON).
inline constexpr std::string_view page_data_mark = "@PSSMLT_REPORT_DATA@";

}  // namespace pssmlt
