// The comparison report: a folder with index.html, which opens from disk without a network,
// data.json for scripts, and images/<id>.js. docs/report.md says what the page shows.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/page_file.h"
#include "app/report/image_pack.h"
#include "core/image/image.h"

namespace pssmlt {

class ReportWriter {
 public:
  using Precision = pssmlt::Precision;

  // Makes the folder and its images/. Throws Failure with the reason if it cannot be written to.
  explicit ReportWriter(std::filesystem::path folder);

  // Writes images/<id>.js at once, atomically; an earlier image of that id is replaced. `id`: what
  // report_id() returns, else Error. `image`: 1 channel (grey), or its R, G, B; linear radiance.
  // Returns what the encoding could not keep, which the page shows too. Throws Failure.
  PackLosses add_image(const std::string& id, const Image& image, Precision precision);

  // Writes data.json and index.html, each atomically; may be called again as the data grow. The
  // schema is in docs/report.md. index.html holds the data without the runs' "statistics".
  // Throws Failure; the files of an earlier call are then still whole.
  void finish(const nlohmann::json& data);

 private:
  std::filesystem::path folder_;
};

// An image id made from any text: letters, digits, '-', '_' and inner '.'; a text that has others,
// or more than 80 bytes, gets a hash of the whole text so that ids stay distinct.
std::string report_id(const std::string& text);

// What the page shows of the data, as JSON: all but the runs' "statistics".
std::string report_page_data(const nlohmann::json& data);
// index.html for these data, which finish() writes.
std::string report_page(const nlohmann::json& data);
// The page for a server: its parts as files of their own, so that a content policy need not allow
// what stands in the page, no data, and live.js, which asks for them ("/data.json", "/events").
std::vector<PageFile> report_live_files();

}  // namespace pssmlt
