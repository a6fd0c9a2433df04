#include "app/report/page_text.h"

#include <algorithm>

namespace pssmlt {
namespace {

void replace(std::string& text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), by);
}

}  // namespace

std::string put_together(const std::vector<PageFile>& files) {
  std::string page = std::ranges::find(files, "/", &PageFile::path)->text;
  for (const PageFile& file : files) {
    const std::string name = file.path.substr(1);
    replace(page, "<script src=\"" + name + "\"></script>", "<script>\n" + file.text + "</script>");
    replace(page, "<link rel=\"stylesheet\" href=\"" + name + "\">",
            "<style>\n" + file.text + "</style>");
  }
  return page;
}

std::string with_data(std::string_view page, std::string_view json) {
  // "<" is legal in JSON's strings only; escaped, no "</script>" or "<!--" can end the element.
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  const size_t at = page.find(page_data_mark);
  return std::string(page.substr(0, at)) + text +
         std::string(page.substr(at + page_data_mark.size()));
}

const std::string& page_text() {
  static const std::string text = put_together(report_page_files());
  return text;
}

}  // namespace pssmlt
