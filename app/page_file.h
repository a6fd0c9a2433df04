// A file that a page consists of, compiled into the program by cmake/embed_page.cmake.
#pragma once

#include <string>
#include <vector>

namespace pssmlt {

struct PageFile {
  std::string path;  // "/live.js"; "/" is the page itself
  std::string type;  // "text/javascript; charset=utf-8"
  std::string text;
};

std::vector<PageFile> live_page_files();    // app/live/page
std::vector<PageFile> report_page_files();  // app/report/page and Chart.js, as "/chart.min.js"
std::vector<PageFile> stress_page_files();  // app/stress/page

}  // namespace pssmlt
