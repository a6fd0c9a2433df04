// Every bad input gives one clear message and exit code 2 with nothing written, or a right picture
// with a warning; never a crash, a hang or a half-written file.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "tests/bad_input/bad_input.h"
#include "tests/bad_input/run_program.h"

namespace pssmlt::test {
namespace {

class Bad : public ::testing::TestWithParam<BadInput> {
 protected:
  // Everything below the folder, with sizes: what a run must leave as it was.
  std::set<std::string> listing() const {
    std::set<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const auto size = entry.is_regular_file() ? entry.file_size() : 0;
      all.insert(entry.path().string() + " " + std::to_string(size));
    }
    return all;
  }
  ProgramResult run(const BadInput& bad) const {
    for (const auto& [name, bytes] : bad.files) folder_.write(name, bytes);
    if (bad.scene != "-") folder_.write("scene.txt", bad.scene);
    std::vector<std::string> arguments = {"scene.txt", "-o",    "out.pfm", "--threads",
                                          "1",         "--spp", "1"};
    if (!bad.arguments.empty()) arguments = bad.arguments;
    return run_program(arguments, folder_);
  }
  TemporaryFolder folder_;
};

void expect_words(const BadInput& bad, const std::string& text) {
  for (const std::string& word : bad.words) {
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
  }
  if (!bad.place.empty()) {
    EXPECT_NE(text.find("scene.txt:" + bad.place + ": "), std::string::npos)
        << bad.place << " is not in: " << text;
  }
  for (const char* word : {"Sanitizer", "runtime error", "terminate called", "Assertion"}) {
    EXPECT_EQ(text.find(word), std::string::npos) << text;
  }
}

void expect_finite_picture(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string magic;
  int width = 0, height = 0;
  float scale = 0.f;
  in >> magic >> width >> height >> scale;
  ASSERT_EQ(magic, "PF") << file;
  in.get();
  std::vector<float> data(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
  in.read(static_cast<char*>(static_cast<void*>(data.data())),
          static_cast<std::streamsize>(data.size() * sizeof(float)));
  ASSERT_TRUE(in) << "short picture";
  for (const float value : data) ASSERT_TRUE(std::isfinite(value) && value >= 0.f) << value;
}

TEST_P(Bad, IsRefusedOrRendered) {
  const BadInput& bad = GetParam();
  for (const auto& [name, bytes] : bad.files) folder_.write(name, bytes);
  if (bad.scene != "-") folder_.write("scene.txt", bad.scene);
  const std::set<std::string> before = listing();
  const ProgramResult result = run(bad);
  expect_words(bad, result.text);
  if (bad.renders) {
    EXPECT_EQ(result.exit_code, 0) << result.text;
    expect_finite_picture(folder_.path() / "out.pfm");
  } else {
    EXPECT_EQ(result.exit_code, 2) << result.text;
    EXPECT_EQ(listing(), before) << result.text;
  }
}

std::string name_of(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Syntax, Bad, ::testing::ValuesIn(bad_syntax()), name_of);
INSTANTIATE_TEST_SUITE_P(Directives, Bad, ::testing::ValuesIn(bad_directives()), name_of);
INSTANTIATE_TEST_SUITE_P(Shapes, Bad, ::testing::ValuesIn(bad_shapes()), name_of);
INSTANTIATE_TEST_SUITE_P(Gltf, Bad, ::testing::ValuesIn(bad_gltf_scenes()), name_of);
INSTANTIATE_TEST_SUITE_P(Files, Bad, ::testing::ValuesIn(bad_files()), name_of);
INSTANTIATE_TEST_SUITE_P(Usage, Bad, ::testing::ValuesIn(bad_usage()), name_of);
INSTANTIATE_TEST_SUITE_P(Poor, Bad, ::testing::ValuesIn(poor_scenes()), name_of);

// Images that the program itself wrote, cut short.
class CutImage : public ::testing::TestWithParam<const char*> {};

TEST_P(CutImage, IsRefused) {
  const TemporaryFolder folder;
  const std::string image = std::string("image.") + GetParam();
  folder.write("good.txt", world(""));
  const ProgramResult good = run_program({"good.txt", "-o", image, "--spp", "1"}, folder);
  ASSERT_EQ(good.exit_code, 0) << good.text;
  fs::resize_file(folder.path() / image, fs::file_size(folder.path() / image) / 2);
  folder.write("scene.txt",
               world("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + image +
                     "\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\" "
                     "Shape \"sphere\""));
  const ProgramResult bad = run_program({"scene.txt", "-o", "out.pfm", "--spp", "1"}, folder);
  EXPECT_EQ(bad.exit_code, 2) << bad.text;
  EXPECT_NE(bad.text.find("scene.txt:4:"), std::string::npos) << bad.text;
  EXPECT_NE(bad.text.find(image), std::string::npos) << bad.text;
  EXPECT_FALSE(fs::exists(folder.path() / "out.pfm"));
}

INSTANTIATE_TEST_SUITE_P(Formats, CutImage, ::testing::Values("exr", "png", "hdr", "jpg", "pfm"),
                         [](const auto& format) { return std::string(format.param); });

// Plugins that the program must not take. The first is built beside this test, with another number
// of the plugin interface in its descriptor.
TEST(BadPlugin, OfAnotherInterfaceIsRefused) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "plugins/material");
  fs::copy_file(PSSMLT_STALE_PLUGIN, folder.path() / "plugins/material/stale.so");
  folder.write("scene.txt", world("Material \"stale\" Shape \"sphere\""));
  const ProgramResult result =
      run_program({"scene.txt", "-o", "out.pfm"}, folder, "PSSMLT_PLUGIN_PATH=plugins");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("scene.txt:4:1: "), std::string::npos) << result.text;
  EXPECT_NE(result.text.find("plugin interface 999"), std::string::npos) << result.text;
  EXPECT_FALSE(fs::exists(folder.path() / "out.pfm"));
}

TEST(BadPlugin, ThatIsNoSharedObjectIsRefused) {
  const TemporaryFolder folder;
  folder.write("plugins/material/text.so", "this is text\n");
  folder.write("scene.txt", world("Material \"text\" Shape \"sphere\""));
  const ProgramResult result =
      run_program({"scene.txt", "-o", "out.pfm"}, folder, "PSSMLT_PLUGIN_PATH=plugins");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("scene.txt:4:1: cannot load plugin"), std::string::npos)
      << result.text;
  EXPECT_FALSE(fs::exists(folder.path() / "out.pfm"));
}

TEST(BadPlugin, SharedObjectOfOthersIsRefused) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "plugins/material");
  fs::copy_file(PSSMLT_OTHER_LIBRARY, folder.path() / "plugins/material/other.so");
  folder.write("scene.txt", world("Material \"other\" Shape \"sphere\""));
  const ProgramResult result =
      run_program({"scene.txt", "-o", "out.pfm"}, folder, "PSSMLT_PLUGIN_PATH=plugins");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("is not a pssmlt plugin"), std::string::npos) << result.text;
}

}  // namespace
}  // namespace pssmlt::test
