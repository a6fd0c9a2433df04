#include "app/compare/technique.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/compare/scene_job.h"
#include "app/compare/text.h"
#include "app/defaults.h"
#include "core/plugin/registry.h"
#include "tests/app/compare/folder.h"

namespace pssmlt::compare {
namespace {

TEST(Technique, ShortNames) {
  const Technique path = parse_technique("path");
  EXPECT_EQ(path.name, "path");
  EXPECT_EQ(path.integrator, "path");
  EXPECT_EQ(path.sampler, default_plugins().sampler);

  // The alias brings its sampler: the builder finds it, as for a scene that names it.
  const Technique mlt = parse_technique(" mlt ");
  EXPECT_EQ(mlt.integrator, "mlt");
  EXPECT_EQ(mlt.sampler, std::nullopt);

  const Technique over_path = parse_technique("mlt(path)");
  EXPECT_EQ(over_path.name, "mlt(path)");
  EXPECT_EQ(over_path.integrator, "path");
  EXPECT_EQ(over_path.sampler, "pssmlt");
  EXPECT_EQ(parse_technique("independent(light)").sampler, "independent");

  const Technique scene = parse_technique("scene");
  EXPECT_FALSE(scene.integrator || scene.sampler);
}

TEST(Technique, EveryIntegratorAndSamplerHasAShortName) {
  for (const std::string& integrator : Registry::instance().names("integrator")) {
    EXPECT_EQ(parse_technique(integrator).integrator, integrator);
    for (const std::string& sampler : Registry::instance().names("sampler")) {
      EXPECT_EQ(parse_technique(sampler + "(" + integrator + ")").sampler, sampler);
    }
  }
}

TEST(Technique, InFull) {
  const Technique t =
      parse_technique("name = integrator:bdpt, maxdepth=8 ; sampler:pssmlt,sigma=0.02");
  EXPECT_EQ(t.name, "name");
  EXPECT_EQ(t.integrator, "bdpt");
  EXPECT_EQ(t.sampler, "pssmlt");
  EXPECT_EQ(t.set, (std::vector<std::string>{"integrator.maxdepth=8", "sampler.sigma=0.02"}));
  EXPECT_EQ(parse_technique("a=sampler:sobol").integrator, std::nullopt);

  BuildOptions base;
  base.set = {"integrator.maxdepth=3"};
  const BuildOptions options = options_for(t, base);
  EXPECT_EQ(options.integrator, "bdpt");
  // What comes later goes over what came before.
  EXPECT_EQ(options.set.front(), "integrator.maxdepth=3");
  EXPECT_EQ(options.set.back(), "sampler.sigma=0.02");
}

std::string refusal(const std::string& text) {
  try {
    (void)parse_technique(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Technique, WrongOnesAreRefusedWithASuggestion) {
  EXPECT_NE(refusal("bdtp").find("did you mean 'bdpt'"), std::string::npos) << refusal("bdtp");
  EXPECT_NE(refusal("pssmtl(path)").find("did you mean 'pssmlt'"), std::string::npos);
  EXPECT_NE(refusal("mlt(pat)").find("did you mean 'path'"), std::string::npos);
  EXPECT_NE(refusal("x=integrator:bdtp").find("did you mean 'bdpt'"), std::string::npos);
  for (const char* text : {"", " ", "()", "mlt(", "mlt()", "path(mlt)", "(path)", "integrator:bdpt",
                           "x=integrator", "x=integrator:", "x=camera:perspective",
                           "x=integrator:path;integrator:bdpt", "x=integrator:path,maxdepth",
                           "x=integrator:path;", "=integrator:path", "../path", "path)"}) {
    EXPECT_FALSE(refusal(text).empty()) << "\"" << text << "\"";
  }
}

TEST(Technique, ListsAndFiles) {
  const auto list = parse_technique_list("path,bdpt,mlt,pssmlt(path)");
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[3].name, "pssmlt(path)");
  EXPECT_THROW((void)parse_technique_list("path,,bdpt"), Error);

  const test::Folder folder;
  write_file(folder / "t.txt", "# mine\npath\n\n  deep=integrator:bdpt,maxdepth=30 # far\n");
  const auto read = read_techniques(folder / "t.txt");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].set, std::vector<std::string>{"integrator.maxdepth=30"});
  write_file(folder / "bad.txt", "path\nbdtp\n");
  try {
    (void)read_techniques(folder / "bad.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bad.txt:2: "), std::string::npos) << error.what();
  }
  write_file(folder / "empty.txt", "# nothing\n");
  EXPECT_THROW((void)read_techniques(folder / "empty.txt"), Error);
  EXPECT_THROW((void)read_techniques(folder / "none.txt"), Error);
}

TEST(Technique, NamesMustDiffer) {
  EXPECT_NO_THROW(check_names_differ(parse_technique_list("path,bdpt")));
  EXPECT_THROW(check_names_differ(parse_technique_list("path,bdpt,path")), Error);
}

TEST(Suite, LinesHaveOptions) {
  const test::Folder folder;
  write_file(folder / "suite.txt",
             "# two\na.txt size=64x32 name=first\nsub/b.pbrt.gz set=integrator.maxdepth=3 "
             "set=camera.fov=30 reference=b.exr # second\na.txt crop=0,8,0,4 scale=0.5\n");
  BuildOptions base;
  base.set = {"sampler.seed=1"};
  auto scenes = read_suite(folder / "suite.txt", base);
  make_names_differ(scenes);
  ASSERT_EQ(scenes.size(), 3u);
  EXPECT_EQ(scenes[0].file, folder / "a.txt");
  EXPECT_EQ(scenes[0].name, "first");
  EXPECT_EQ(scenes[0].build.size, ivec2(64, 32));
  EXPECT_EQ(scenes[1].name, "b");
  EXPECT_EQ(scenes[1].reference, folder / "b.exr");
  EXPECT_EQ(scenes[1].build.set.size(), 3u);
  EXPECT_EQ(scenes[2].build.scale, 0.5f);
  ASSERT_TRUE(scenes[2].build.crop);
  EXPECT_EQ((*scenes[2].build.crop)[1], 8);

  for (const char* bad :
       {"a.txt sise=3x4", "a.txt size", "a.txt size=3", "a.txt scale=-1", "a.txt crop=1,2"}) {
    write_file(folder / "bad.txt", std::string("\n") + bad + "\n");
    try {
      (void)read_suite(folder / "bad.txt", base);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bad.txt:2: "), std::string::npos) << error.what();
    }
  }
}

TEST(Suite, SameNamesAreToldApart) {
  std::vector<SceneRequest> scenes = {request_for("a/room.txt", {}), request_for("b/room.txt", {}),
                                      request_for("b/hall.txt.gz", {})};
  make_names_differ(scenes);
  EXPECT_EQ(scenes[0].name, "room");
  EXPECT_EQ(scenes[1].name, "room-2");
  EXPECT_EQ(scenes[2].name, "hall");
}

// The project's own suite names its scenes and only those.
TEST(Suite, OfTheProjectIsComplete) {
  const std::filesystem::path folder = std::filesystem::path(PSSMLT_SOURCE_DIR) / "scenes";
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files += entry.path().extension() == ".txt" && entry.path().filename() != "suite.txt" ? 1 : 0;
  }
  const auto scenes = read_suite((folder / "suite.txt").string(), {});
  EXPECT_EQ(scenes.size(), files);
  for (const SceneRequest& s : scenes) EXPECT_TRUE(std::filesystem::exists(s.file)) << s.file;
}

}  // namespace
}  // namespace pssmlt::compare
