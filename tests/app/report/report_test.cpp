// The report's files: whole or absent, harmless whatever names are in the data.
#include "app/report/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/report/page_text.h"
#include "core/base/error.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pssmlt::ReportWriter;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("pssmlt-report-" + std::to_string(getpid()))) {
    fs::remove_all(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

json data_with_name(const std::string& name) {
  return {{"format", 1}, {"scenes", {{{"name", name}, {"techniques", json::array()}}}}};
}

// The JSON between the data element's tags.
json embedded(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const size_t begin = page.find(open) + open.size();
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(Report, WritesAllFilesAndLeavesNoTemporaryOnes) {
  const Folder folder;
  ReportWriter writer(folder.path() / "deep" / "report");
  writer.add_image("a", pssmlt::Image(2, 2, 3), ReportWriter::Precision::exact);
  writer.finish(data_with_name("one"));
  writer.finish(data_with_name("two"));
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    if (entry.is_regular_file()) names.push_back(entry.path().filename());
  }
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"a.js", "data.json", "index.html"}));
  EXPECT_EQ(json::parse(read(folder.path() / "deep/report/data.json")), data_with_name("two"));
  EXPECT_EQ(embedded(read(folder.path() / "deep/report/index.html")), data_with_name("two"));
}

// A reader that has the old file open, or opens it at any time, sees a whole file: the new one is
// another inode.
TEST(Report, FilesAreReplacedNotOverwritten) {
  const Folder folder;
  ReportWriter writer(folder.path());
  writer.finish(data_with_name("one"));
  std::ifstream old(folder.path() / "index.html");
  writer.finish(data_with_name("two"));
  std::stringstream text;
  text << old.rdbuf();
  EXPECT_EQ(embedded(text.str()), data_with_name("one"));
}

TEST(Report, AFailedFinishLeavesTheEarlierReport) {
  const Folder folder;
  ReportWriter writer(folder.path());
  writer.finish(data_with_name("one"));
  // In the way of the rename, whoever runs this.
  fs::remove(folder.path() / "index.html");
  fs::create_directories(folder.path() / "index.html" / "in the way");
  EXPECT_THROW(writer.finish(data_with_name("two")), pssmlt::Failure);
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
  }
}

TEST(Report, FoldersThatCannotBeWrittenAreRefusedAtOnce) {
  const Folder folder;
  fs::create_directories(folder.path());
  std::ofstream(folder.path() / "file") << "not a folder";
  EXPECT_THROW(ReportWriter(folder.path() / "file"), pssmlt::Failure);
  EXPECT_THROW(ReportWriter(folder.path() / "file" / "below"), pssmlt::Failure);
  EXPECT_THROW(ReportWriter("/proc/pssmlt-report"), pssmlt::Failure);
  if (getuid() == 0) return;  // root may write anywhere
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(ReportWriter(folder.path() / "report"), pssmlt::Failure);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(Report, NamesCannotEndTheElementThatHoldsThem) {
  const json data = data_with_name("</script><script>alert(1)</script><!-- \xe2\x80\xa8 \xff");
  const std::string page = pssmlt::report_page(data);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.find("</script><script>alert"), std::string::npos);
  const std::string name = embedded(page)["scenes"][0]["name"];
  EXPECT_TRUE(name.starts_with("</script><script>alert(1)</script><!-- \xe2\x80\xa8 "));
}

TEST(Report, NumbersThatJsonCannotHoldBecomeNull) {
  json data = data_with_name("x");
  data["scenes"][0]["load_seconds"] = NAN;
  EXPECT_TRUE(embedded(pssmlt::report_page(data))["scenes"][0]["load_seconds"].is_null());
}

TEST(Report, ThePageLeavesOutRunStatistics) {
  json data = data_with_name("x");
  data["scenes"][0]["techniques"] = {{{"runs", {{{"seed", 3}, {"statistics", {{"large", 1}}}}}}}};
  const json run = embedded(pssmlt::report_page(data))["scenes"][0]["techniques"][0]["runs"][0];
  EXPECT_EQ(run, (json{{"seed", 3}}));
}

TEST(Report, IdsAreFileNames) {
  const Folder folder;
  ReportWriter writer(folder.path());
  const pssmlt::Image image(1, 1, 3);
  for (const char* id : {"", "../up", "a/b", ".hidden", "a b", "<script>", "a\"b", "\xc3\xa4"}) {
    EXPECT_THROW(writer.add_image(id, image, ReportWriter::Precision::exact), pssmlt::Error) << id;
    const std::string made = pssmlt::report_id(id);
    EXPECT_NO_THROW(writer.add_image(made, image, ReportWriter::Precision::exact)) << made;
  }
  EXPECT_EQ(pssmlt::report_id("door-ajar.mlt_3.25"), "door-ajar.mlt_3.25");
  EXPECT_NE(pssmlt::report_id("a b"), pssmlt::report_id("a_b"));
  EXPECT_NE(pssmlt::report_id("a b"), pssmlt::report_id("a/b"));
  EXPECT_LE(pssmlt::report_id(std::string(5000, 'x')).size(), 100u);
}

TEST(Report, ThePageNeedsNothingFromElsewhere) {
  const std::string page(pssmlt::page_text());
  EXPECT_LT(page.size(), 600'000u);
  EXPECT_NE(page.find("Chart.js v3"), std::string::npos) << "its licence stays with it";
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_EQ(page.find("<link rel=\"stylesheet\""), std::string::npos);
  const size_t mark = page.find(pssmlt::page_data_mark);
  ASSERT_NE(mark, std::string::npos);
  EXPECT_EQ(page.find(pssmlt::page_data_mark, mark + 1), std::string::npos);
}

// On disk nothing looks for a server; from a server nothing stands in the page that a strict
// content policy would refuse.
TEST(Report, OnlyAServersPageIsLive) {
  EXPECT_EQ(pssmlt::page_text().find("EventSource"), std::string::npos);
  const std::vector<pssmlt::PageFile> files = pssmlt::report_live_files();
  const auto text = [&](const std::string& path) {
    const auto file = std::ranges::find(files, path, &pssmlt::PageFile::path);
    return file != files.end() ? file->text : "";
  };
  const std::string page = text("/");
  EXPECT_EQ(json::parse(page.substr(page.find("{}"), 2)), json::object());
  EXPECT_EQ(page.find(pssmlt::page_data_mark), std::string::npos);
  for (const char* inline_code : {"<style", "style=", "<script>", "onclick"}) {
    EXPECT_EQ(page.find(inline_code), std::string::npos) << inline_code;
  }
  EXPECT_LT(page.find("main.js"), page.find("live.js"));
  EXPECT_NE(text("/live.js").find("EventSource"), std::string::npos);
  for (const pssmlt::PageFile& file : files) {
    if (file.path == "/") continue;
    EXPECT_EQ(file.text.find("</script"), std::string::npos) << "ends its element on disk";
  }
}

}  // namespace
