// pssmlt error on files: formats, maps, JSON, and what it refuses. Error becomes exit code 2.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/metrics/metrics.h"
#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

class ErrorCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  Image image(int width, int height, float shift) const {
    Image result(width, height, 3);
    for (size_t i = 0; i < result.data.size(); ++i) {
      result.data[i] = 0.4f + shift + 0.3f * std::sin(0.7f * float(i));
    }
    return result;
  }
  // What the command prints.
  static std::string run(const Arguments& arguments) {
    testing::internal::CaptureStdout();
    int code = -1;
    try {
      code = run_error(arguments);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_EQ(code, 0);
    return text;
  }
  static std::string refusal(const Arguments& arguments) {
    try {
      run(arguments);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  nlohmann::json numbers(const std::string& name) const {
    return nlohmann::json::parse(std::ifstream(path(name)));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ErrorCommand, PrintsAndWritesAllMetrics) {
  write_image(path("a.exr"), image(20, 11, 0.1f), {}, {});
  write_image(path("b.exr"), image(20, 11, 0.f), {}, {});
  const std::string text = run({path("a.exr"), path("b.exr"), "--json", path("e.json")});
  const nlohmann::json j = numbers("e.json");
  ASSERT_EQ(j["metrics"].size(), metrics().size());
  for (size_t m = 0; m < metrics().size(); ++m) {
    EXPECT_NE(text.find(metrics()[m].name), std::string::npos);
    EXPECT_EQ(j["metrics"][m]["id"], std::string(metrics()[m].id));
    EXPECT_GT(j["metrics"][m]["value"].get<double>(), 0.0);
  }
  EXPECT_NEAR(j["metrics"][0]["value"].get<double>(), 0.01, 1e-6);
  EXPECT_GT(j["mean_bias"]["value"].get<double>(), 0.0);
  EXPECT_EQ(j["non_finite"], 0);
  EXPECT_EQ(j["width"], 20);
}

TEST_F(ErrorCommand, OnlyTheMetricsAskedFor) {
  write_image(path("a.pfm"), image(5, 5, 0.1f), {}, {});
  const std::string text = run({"--metric", "mse", path("a.pfm"), path("a.pfm"), "--metric",
                                "smape", "--json", path("e.json")});
  EXPECT_EQ(numbers("e.json")["metrics"].size(), 2u);
  EXPECT_EQ(text.find("FLIP"), std::string::npos);
  run({"--metric", "mse,flip", path("a.pfm"), path("a.pfm"), "--json", path("e.json")});
  EXPECT_EQ(numbers("e.json")["metrics"].size(), 2u);
}

// 8-bit files hold sRGB: 188 of 255 is 0.5029 of linear light.
TEST_F(ErrorCommand, PngIsDecoded) {
  Image grey(4, 4, 3);
  for (float& v : grey.data) v = 0.5029f;
  write_image(path("a.png"), grey, {}, {});
  write_image(path("a.exr"), grey, {}, {});
  run({path("a.png"), path("a.exr"), "--json", path("e.json")});
  EXPECT_LT(numbers("e.json")["metrics"][0]["value"].get<double>(), 1e-5);
}

TEST_F(ErrorCommand, LayersDoNotCount) {
  const Image plain = image(6, 4, 0.f);
  Image layered(6, 4, 5);
  layered.channel_names = {"R", "G", "B", "depth.Y", "A"};
  for (int p = 0; p < 24; ++p) {
    for (int c = 0; c < 5; ++c) {
      layered.data[size_t(p * 5 + c)] = c < 3 ? plain.data[size_t(p * 3 + c)] : 99.f;
    }
  }
  write_image(path("a.exr"), layered, {}, {});
  write_image(path("b.exr"), plain, {}, {});
  run({path("a.exr"), path("b.exr"), "--json", path("e.json")});
  const nlohmann::json j = numbers("e.json");
  for (const auto& m : j["metrics"]) EXPECT_EQ(m["value"].get<double>(), 0.0);
}

TEST_F(ErrorCommand, MapsAverageToTheMetric) {
  write_image(path("a.exr"), image(20, 11, 0.1f), {}, {});
  write_image(path("b.exr"), image(20, 11, 0.f), {}, {});
  for (const Metric& m : metrics()) {
    const std::string id(m.id);
    run({path("a.exr"), path("b.exr"), "--metric", id, "--map", path("m.exr"), "--map-metric", id,
         "--json", path("e.json")});
    const Image map = read_image(path("m.exr"), "");
    ASSERT_EQ(map.width, 20);
    ASSERT_EQ(map.channels, 1);
    double mean = 0.0;
    for (const float v : map.data) mean += double(v) / 220.0;
    EXPECT_NEAR(mean, numbers("e.json")["metrics"][0]["value"].get<double>(), 1e-6) << id;
  }
  run({path("a.exr"), path("b.exr"), "--map", path("m.png")});
  EXPECT_EQ(read_image(path("m.png"), "").width, 20);
}

TEST_F(ErrorCommand, PixelsThatAreNotFiniteAreCounted) {
  Image bad = image(7, 5, 0.1f);
  bad.data[4] = std::numeric_limits<float>::quiet_NaN();
  bad.data[50] = std::numeric_limits<float>::infinity();
  write_image(path("a.exr"), bad, {}, {});
  write_image(path("b.exr"), image(7, 5, 0.f), {}, {});
  const std::string text = run({path("a.exr"), path("b.exr"), "--json", path("e.json")});
  EXPECT_NE(text.find("2 pixels are not finite"), std::string::npos) << text;
  EXPECT_EQ(numbers("e.json")["non_finite"], 2);
}

TEST_F(ErrorCommand, BlackReferenceIsSaid) {
  write_image(path("a.exr"), image(7, 5, 0.1f), {}, {});
  write_image(path("b.exr"), Image(7, 5, 3), {}, {});
  const std::string text = run({path("a.exr"), path("b.exr"), "--json", path("e.json")});
  EXPECT_NE(text.find("black"), std::string::npos) << text;
  EXPECT_TRUE(numbers("e.json")["metrics"][1]["value"].is_null());
}

TEST_F(ErrorCommand, RefusesWithTheFilesNames) {
  write_image(path("a.exr"), image(8, 6, 0.f), {}, {});
  write_image(path("b.exr"), image(6, 8, 0.f), {}, {});
  const std::string sizes = refusal({path("a.exr"), path("b.exr")});
  for (const std::string& part :
       {path("a.exr"), path("b.exr"), std::string("8 x 6"), std::string("6 x 8")}) {
    EXPECT_NE(sizes.find(part), std::string::npos) << sizes;
  }
  write_image(path("cut.exr"), image(64, 64, 0.f), {}, {});
  std::filesystem::resize_file(path("cut.exr"), std::filesystem::file_size(path("cut.exr")) / 2);
  folder_.write("text.exr", "this is not an image");
  folder_.write("empty.exr", "");
  for (const char* const name : {"cut.exr", "text.exr", "empty.exr", "missing.exr", ""}) {
    const std::string said = refusal({path("a.exr"), path(name)});
    EXPECT_NE(said.find(path(name)), std::string::npos) << name << ": " << said;
  }
}

TEST_F(ErrorCommand, RefusesBadUsage) {
  write_image(path("a.exr"), image(8, 6, 0.f), {}, {});
  const std::string a = path("a.exr");
  for (const Arguments& arguments : std::vector<Arguments>{{},
                                                           {a},
                                                           {a, a, a},
                                                           {a, a, "--metric", "rmse"},
                                                           {a, a, "--map-metric", ""},
                                                           {a, a, "--map", path("m.xyz")},
                                                           {a, a, "--map", path("nowhere/m.exr")},
                                                           {a, a, "--json", path("nowhere/e.json")},
                                                           {a, a, "--threads", "0"},
                                                           {a, a, "--nonsense"}}) {
    EXPECT_NE(refusal(arguments), "");
  }
  EXPECT_NE(refusal({a, a, "--metric", "relmsr"}).find("did you mean 'relmse'"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
