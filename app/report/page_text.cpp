#include "app/report/page_text.h"

#include <algorithm>

#include "app/page_file.h"

namespace pssmlt {
namespace {

void replace(std::string& text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), by);
}

// What the page does not name is left out.
std::string put_together() {
  const std::vector<PageFile> files = report_page_files();
  std::string page = std::ranges::find(files, "/", &PageFile::path)->text;
  for (const PageFile& file : files) {
    const std::string name = file.path.substr(1);
    replace(page, "<script src=\"" + name + "\"></script>", "<script>\n" + file.text + "</script>");
    replace(page, "<link rel=\"stylesheet\" href=\"" + name + "\">",
            "<style>\n" + file.text + "</style>");
  }
  return page;
}

}  // namespace

const std::string& page_text() {
  static const std::string text = put_together();
  return text;
}

}  // namespace pssmlt
