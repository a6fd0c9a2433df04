// Pages as one text: HTML with style sheets and scripts in their places, and the data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/page_file.h"

namespace pssmlt {

// The comparison report's page.
const std::string& page_text();
// Stands in the text, once, where the data go (as JSON).
inline constexpr std::string_view page_data_mark = "@PSSMLT_REPORT_DATA@";

// The file "/" with every other that it names put in; what it does not name is left out.
std::string put_together(const std::vector<PageFile>& files);
// `page` with these data, JSON, at the mark.
std::string with_data(std::string_view page, std::string_view json);

}  // namespace pssmlt
