#include "app/report/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/report/page_text.h"
#include "core/base/error.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t max_id = 80;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw Failure("cannot write " + path.string() + ": " + reason);
}

// A temporary file beside it, then a rename: a reader sees the old file or the new one.
void write_file(const fs::path& path, const std::string& text) {
  const fs::path temporary =
      path.parent_path() / ("." + path.filename().string() + ".tmp" + std::to_string(getpid()));
  errno = 0;
  std::ofstream out(temporary, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  std::error_code error;
  if (!out) {
    error = std::error_code(errno != 0 ? errno : EIO, std::generic_category());
  } else {
    fs::rename(temporary, path, error);
  }
  if (!error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fail(path, error.message());
}

bool id_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

bool is_id(const std::string& text) {
  if (text.empty() || text.size() > max_id + 17 || text.front() == '.') return false;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 128 || !id_character(c)) return false;
  }
  return true;
}

// FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv/.
uint64_t hash_of(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

// What the page does not show and may be large.
json for_page(json data) {
  for (json& scene : data["scenes"]) {
    for (json& technique : scene["techniques"]) {
      for (json& run : technique["runs"]) run.erase("statistics");
    }
  }
  return data;
}

std::string dump(const json& data, int indent) {
  return data.dump(indent, ' ', true, json::error_handler_t::replace);
}

}  // namespace

std::string report_id(const std::string& text) {
  if (is_id(text) && text.size() <= max_id) return text;
  std::string id;
  for (const char c : text.substr(0, max_id)) {
    id += static_cast<unsigned char>(c) < 128 && id_character(c) && !(id.empty() && c == '.') ? c
                                                                                              : '_';
  }
  return fmt::format("{}-{:016x}", id, hash_of(text));
}

std::string report_page_data(const json& data) { return dump(for_page(data), -1); }

std::string report_page(const json& data) { return with_data(page_text(), report_page_data(data)); }

std::vector<PageFile> report_live_files() {
  std::vector<PageFile> files = report_page_files();
  std::string& page = std::ranges::find(files, "/", &PageFile::path)->text;
  const auto put = [&page](std::string_view at, const std::string& text, size_t instead = 0) {
    page.replace(page.find(at), instead, text);
  };
  put(page_data_mark, "{}", page_data_mark.size());
  put("</head>", "<link rel=\"stylesheet\" href=\"live.css\">\n");
  put("</body>", "<script src=\"live.js\"></script>\n");
  return files;
}

ReportWriter::ReportWriter(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_ / "images", error);
  if (error) fail(folder_, error.message());
  for (const fs::path& where : {folder_, folder_ / "images"}) {
    const fs::path probe = where / (".probe" + std::to_string(getpid()));
    write_file(probe, "");
    fs::remove(probe, error);
  }
}

PackLosses ReportWriter::add_image(const std::string& id, const Image& image, Precision precision) {
  if (!is_id(id)) throw Error("'" + id + "' cannot name an image of a report");
  const PackedImage packed = pack_image(image, precision);
  write_file(folder_ / "images" / (id + ".js"), image_script(id, packed));
  return packed.losses;
}

void ReportWriter::finish(const json& data) {
  write_file(folder_ / "data.json", dump(data, 1) + "\n");
  write_file(folder_ / "index.html", report_page(data));
}

}  // namespace pssmlt
