// The cache of references. How many rounds fit into a time does not matter to any of these tests.
#include "app/compare/reference_cache.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/compare/text.h"
#include "tests/app/compare/small_room.h"

namespace pssmlt::compare {
namespace {

class ReferenceCache : public testing::Test {
 protected:
  ReferenceCache() {
    setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    request_.techniques = parse_technique_list("path,independent(path)");
    request_.seconds = 0.2;
    request_.threads = 2;
    request_.slice = 0.01;
    request_.progress = [this](double seconds) { progress_ = seconds; };
  }
  ~ReferenceCache() override { unsetenv("XDG_CACHE_HOME"); }
  std::optional<Reference> make() {
    progress_ = 0.0;
    return make_reference(scene_, test::small_options(), request_);
  }
  std::filesystem::path entry() const {
    return reference_folder() / reference_key(scene_, test::small_options(), request_.techniques);
  }
  test::Folder folder_;
  LoadedScene scene_ = test::load_small(folder_);
  ReferenceRequest request_;
  double progress_ = 0.0;
};

TEST_F(ReferenceCache, IsMadeOnceAndGrows) {
  const auto made = make();
  ASSERT_TRUE(made);
  EXPECT_GE(made->seconds, 0.2);
  EXPECT_GT(progress_, 0.0);
  EXPECT_EQ(made->techniques, (std::vector<std::string>{"path", "independent(path)"}));
  const auto again = make();
  EXPECT_EQ(progress_, 0.0) << "nothing is rendered";
  EXPECT_EQ(again->image.data, made->image.data);
  EXPECT_EQ(again->seconds, made->seconds);
  ASSERT_TRUE(again->agreement);
  EXPECT_EQ(again->agreement->text, made->agreement->text);
  for (size_t m = 0; m < made->floor.size(); ++m) {
    EXPECT_NEAR(*again->floor[m], *made->floor[m], 1e-6 * *made->floor[m]);
  }
  request_.seconds = made->seconds + 0.1;
  const auto longer = make();
  EXPECT_GE(longer->seconds, request_.seconds);
  EXPECT_GT(progress_, made->seconds) << "continues from where it was";
}

TEST_F(ReferenceCache, AnInterruptedOneIsContinued) {
  std::atomic<bool> stop{false};
  request_.stop = &stop;
  request_.seconds = 1e6;
  request_.progress = [&](double seconds) {
    progress_ = seconds;
    stop = seconds > 0.05;
  };
  EXPECT_FALSE(make());
  const double before = progress_;
  EXPECT_GT(before, 0.05);
  stop = false;
  double first = 0.0;
  request_.seconds = 2.0 * before + 0.1;
  request_.progress = [&](double seconds) { first = first == 0.0 ? seconds : first; };
  ASSERT_TRUE(make());
  EXPECT_GE(first, before);
}

TEST_F(ReferenceCache, DamageIsRepaired) {
  ASSERT_TRUE(make());
  for (const char* file : {"reference.json", "state-0.checkpoint", "reference.exr"}) {
    std::ofstream(entry() / file, std::ios::trunc) << "{ not what it was";
    EXPECT_TRUE(make()) << file;
  }
}

TEST_F(ReferenceCache, KeyFollowsWhatItDependsOn) {
  const auto key = [&](const BuildOptions& options, const std::string& techniques) {
    const LoadedScene scene = test::load_small(folder_, options);
    return reference_key(scene, options, parse_technique_list(techniques));
  };
  const BuildOptions options = test::small_options();
  const std::string one = key(options, "path,bdpt");
  EXPECT_EQ(key(options, "path,bdpt"), one);
  EXPECT_NE(key(options, "bdpt,path"), one);
  EXPECT_NE(key(options, "path,light"), one);
  BuildOptions other = options;
  other.size = ivec2(16, 12);
  EXPECT_NE(key(other, "path,bdpt"), one);
  other = options;
  other.set.push_back("integrator.maxdepth=3");
  EXPECT_NE(key(other, "path,bdpt"), one);
}

TEST_F(ReferenceCache, SeedsAreTheirOwn) {
  EXPECT_NE(reference_seed(0), reference_seed(1));
  for (int i = 0; i < 2; ++i) EXPECT_GT(reference_seed(i), uint64_t{1} << 40);
}

// A folder that cannot be made: the reference is made all the same.
TEST_F(ReferenceCache, WorksWithoutACache) {
  write_file(folder_ / "file", "");
  setenv("XDG_CACHE_HOME", (folder_ / "file").c_str(), 1);
  EXPECT_TRUE(make());
}

}  // namespace
}  // namespace pssmlt::compare
