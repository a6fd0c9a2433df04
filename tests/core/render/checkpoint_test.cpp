#include "core/render/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "tests/core/render/session_support.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

using test::build_small;
using test::settings_for;

class Checkpoint : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = (fs::temp_directory_path() /
             ("pssmlt-" + std::string(info->name()) + std::to_string(getpid())))
                .string();
  }
  void TearDown() override { fs::remove(path_); }
  std::string path_;
};

std::string message_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Checkpoint, RoundTrip) {
  const CheckpointIdentity id{1, 2, 3};
  const std::string state = std::string("state\0with zeros", 16) + std::string(1000, 'x');
  write_checkpoint(path_, id, state);
  EXPECT_EQ(read_checkpoint(path_, id), state);
  EXPECT_FALSE(fs::exists(path_ + ".part"));
}

TEST_F(Checkpoint, RefusesOthers) {
  write_checkpoint(path_, {1, 2, 3}, "state");
  const auto read = [&](const CheckpointIdentity& id) {
    return message_of([&] { (void)read_checkpoint(path_, id); });
  };
  EXPECT_NE(read({9, 2, 3}).find("another scene"), std::string::npos);
  EXPECT_NE(read({1, 9, 3}).find("other settings"), std::string::npos);
  EXPECT_NE(read({1, 2, 9}).find("other plugins"), std::string::npos);
}

TEST_F(Checkpoint, RefusesDamage) {
  const CheckpointIdentity id{1, 2, 3};
  write_checkpoint(path_, id, std::string(1000, 'x'));
  const auto size = fs::file_size(path_);
  const auto read = [&] { return message_of([&] { (void)read_checkpoint(path_, id); }); };
  for (const uintmax_t at :
       {uintmax_t{0}, uintmax_t{9}, uintmax_t{13}, uintmax_t{45}, size / 2, size - 1}) {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char before = static_cast<char>(file.get());
    const auto put = [&](char c) {
      file.seekp(static_cast<std::streamoff>(at));
      file.put(c);
      file.flush();
    };
    put(static_cast<char>(before ^ 4));
    EXPECT_NE(read(), "") << "byte " << at;
    put(before);
    EXPECT_EQ(read(), "");
  }
  for (const uintmax_t length : {size - 1, uintmax_t{20}, uintmax_t{0}}) {
    fs::resize_file(path_, length);
    EXPECT_NE(read(), "") << length << " bytes";
  }
}

TEST_F(Checkpoint, UnwritablePlacesAreFailures) {
  EXPECT_THROW(write_checkpoint("/nonexistent/folder/file", {}, "state"), Failure);
}

// A finished render is continued with a larger budget: the same bits as in one go.
TEST_F(Checkpoint, ContinuedRendersAgreeBitForBit) {
  for (const std::string& sampler : Registry::instance().names("sampler")) {
    for (const std::string& integrator : Registry::instance().names("integrator")) {
      fs::remove(path_);
      RenderSettings settings = settings_for(2, 2);
      settings.checkpoint = path_;
      settings.per_length = true;
      (void)render(build_small(integrator, sampler), settings);
      settings.resume = true;
      settings.threads = 3;
      settings.spp = 5;
      const RenderResult resumed = render(build_small(integrator, sampler), settings);
      RenderSettings once = settings_for(5, 1);
      once.per_length = true;
      const RenderResult whole = render(build_small(integrator, sampler), once);
      EXPECT_EQ(resumed.rounds, whole.rounds);
      EXPECT_EQ(resumed.image.data, whole.image.data) << integrator << " under " << sampler;
      ASSERT_EQ(resumed.splits.size(), whole.splits.size());
      for (size_t i = 0; i < whole.splits.size(); ++i) {
        EXPECT_EQ(resumed.splits[i].image.data, whole.splits[i].image.data);
      }
      EXPECT_EQ(resumed.error.mean, whole.error.mean);
    }
  }
}

TEST_F(Checkpoint, SessionRefusesOtherSettings) {
  RenderSettings settings = settings_for(2);
  settings.checkpoint = path_;
  (void)render(build_small("path", "sobol"), settings);
  settings.resume = true;
  const auto refused = [&](const BuiltScene& scene, const RenderSettings& s) {
    return message_of([&] { (void)render(scene, s); });
  };
  EXPECT_EQ(refused(build_small("path", "sobol"), settings), "");
  EXPECT_NE(refused(build_small("bdpt", "sobol"), settings), "");
  EXPECT_NE(refused(build_small("path", "independent"), settings), "");
  EXPECT_NE(refused(build_small("path", "sobol", "# another text"), settings), "");
  BuildOptions options;
  options.set = {"integrator.maxdepth=3"};
  EXPECT_NE(refused(build_small("path", "sobol", "", options), settings), "");
  RenderSettings other = settings;
  other.seed = 77;
  EXPECT_NE(refused(build_small("path", "sobol"), other), "");
  other = settings;
  other.per_length = true;
  EXPECT_NE(refused(build_small("path", "sobol"), other), "");
}

TEST_F(Checkpoint, NothingToResumeStartsAnew) {
  RenderSettings settings = settings_for(2);
  settings.checkpoint = path_;
  settings.resume = true;
  EXPECT_TRUE(render(build_small("path", "sobol"), settings).complete);
  EXPECT_TRUE(fs::exists(path_));
}

}  // namespace
}  // namespace pssmlt
