#include "app/stress/report_page.h"

#include <nlohmann/json.hpp>

#include "app/report/page_text.h"

namespace pssmlt::stress {
namespace {

// The page's own files, then what it borrows from the comparison report.
std::string page() {
  std::vector<PageFile> files = stress_page_files();
  for (PageFile& file : report_page_files()) {
    if (file.path != "/") files.push_back(std::move(file));
  }
  return put_together(files);
}

}  // namespace

std::string report_page(const nlohmann::json& data) {
  using nlohmann::json;
  return with_data(page(), data.dump(-1, ' ', true, json::error_handler_t::replace));
}

}  // namespace pssmlt::stress
