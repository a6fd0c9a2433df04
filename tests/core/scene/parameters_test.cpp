#include "core/scene/parameters.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "core/scene/parser.h"
#include "core/texture.h"

namespace pssmlt {
namespace {

class Resolver final : public SceneResolver {
 public:
  std::shared_ptr<const Texture<float>> float_texture(const std::string& name,
                                                      const Location& where) override {
    if (name != "wood") throw Error(where, "no texture " + name);
    return constant_texture(42.f);
  }
  std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string& name,
                                                  const Location& where) override {
    if (name != "wood") throw Error(where, "no texture " + name);
    return constant_texture(Rgb(4.f, 5.f, 6.f));
  }
  std::string resolve_path(const std::string& name) const override {
    return (std::filesystem::path(::testing::TempDir()) / name).string();
  }
  std::shared_ptr<const Material> material(const std::string&, const Location& where) override {
    throw Error(where, "no material");
  }
};

// A directive and its reader.
struct Case {
  explicit Case(const std::string& list)
      : scene(parse_string("WorldBegin\nShape \"x\" " + list, "scene")),
        parameters(scene.shapes[0].parameters, scene.shapes[0].where, "shape \"x\"", &resolver) {}
  SceneDescription scene;
  Resolver resolver;
  Parameters parameters;
};

template <typename Read>
std::string message(const std::string& list, Read read) {
  Case c(list);
  try {
    read(c.parameters);
    c.parameters.check_all_read();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_words(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
}

TEST(Parameters, Scalars) {
  Case c(
      "\"float f\" 1.5 \"integer i\" -3 \"bool b\" true \"string s\" \"t\" \"point3 p\" [1 2 3]"
      "\"vector3 v\" [4 5 6]");
  Parameters& p = c.parameters;
  EXPECT_TRUE(p.has("f"));
  EXPECT_FALSE(p.has("g"));
  EXPECT_EQ(p.type("i"), ParameterType::Integer);
  EXPECT_EQ(p.type("g"), std::nullopt);
  EXPECT_THROW(p.check_all_read(), Error);  // asking what there is reads nothing
  EXPECT_EQ(p.number("f", 0, "m", "d"), 1.5f);
  EXPECT_EQ(p.integer("i", 0, "", "d"), -3);
  EXPECT_TRUE(p.flag("b", false, "d"));
  EXPECT_EQ(p.text("s", "", "d"), "t");
  EXPECT_EQ(p.point("p", {}, "m", "d"), vec3(1, 2, 3));
  EXPECT_EQ(p.vector("v", {}, "d"), vec3(4, 5, 6));
  EXPECT_NO_THROW(p.check_all_read());
}

TEST(Parameters, Fallbacks) {
  Case c("");
  Parameters& p = c.parameters;
  EXPECT_EQ(p.number("f", 2.5f, "m", "d"), 2.5f);
  EXPECT_EQ(p.integer("i", 7, "", "d"), 7);
  EXPECT_TRUE(p.flag("b", true, "d"));
  EXPECT_EQ(p.text("s", "x", "d"), "x");
  EXPECT_EQ(p.file("filename", "d"), "");
  EXPECT_EQ(p.rgb("c", Rgb(.5f), SpectrumUse::Albedo, "", "d"), Rgb(.5f));
  EXPECT_FALSE(p.spectrum("k", "", "d").has_value());
  EXPECT_TRUE(p.numbers("n", "", "d").empty());
  EXPECT_TRUE(p.points3("P", "", "d").empty());
  EXPECT_EQ(p.float_texture("t", 3.f, "", "d")->evaluate(Hit()), 3.f);
  EXPECT_EQ(p.optional_float_texture("alpha", "d"), nullptr);
}

TEST(Parameters, Arrays) {
  Case c(
      "\"float n\" [1 2] \"integer i\" [3 4] \"point2 uv\" [1 2 3 4] \"point3 P\" [1 2 3 4 5 6]"
      "\"normal N\" [0 0 1] \"string s\" [\"a\" \"b\"] \"rgb g\" [1 2 3 4 5 6]");
  Parameters& p = c.parameters;
  EXPECT_EQ(p.numbers("n", "", "d"), (std::vector<float>{1, 2}));
  EXPECT_EQ(p.integers("i", "", "d"), (std::vector<int>{3, 4}));
  EXPECT_EQ(p.points2("uv", "", "d"), (std::vector<vec2>{{1, 2}, {3, 4}}));
  EXPECT_EQ(p.points3("P", "", "d"), (std::vector<vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(p.normals("N", "d"), (std::vector<vec3>{{0, 0, 1}}));
  EXPECT_EQ(p.texts("s", "d"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(p.rgbs("g", "", "d"), (std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_NO_THROW(p.check_all_read());
}

TEST(Parameters, Textures) {
  Case c("\"texture a\" \"wood\" \"float b\" 2 \"texture c\" \"wood\" \"rgb d\" [.1 .2 .3]");
  Parameters& p = c.parameters;
  EXPECT_EQ(p.float_texture("a", 0.f, "", "d")->evaluate(Hit()), 42.f);
  EXPECT_EQ(p.optional_float_texture("b", "d")->evaluate(Hit()), 2.f);
  const auto use = SpectrumUse::Albedo;
  EXPECT_EQ(p.rgb_texture("c", Rgb(0), use, "", "d")->evaluate(Hit()), Rgb(4, 5, 6));
  const auto d = p.rgb_texture("d", Rgb(0), use, "", "d");
  EXPECT_TRUE(d->constant());
  EXPECT_NEAR(d->evaluate(Hit()).y, .2f, 1e-5f);
  EXPECT_NO_THROW(p.check_all_read());
}

TEST(Parameters, UnknownNamesAreReportedWithASuggestion) {
  expect_words(
      message("\"float raduis\" 1", [](Parameters& p) { p.number("radius", 1, "m", ""); }),
      {"scene:2:11: unknown parameter \"raduis\" of shape \"x\"", "did you mean 'radius'"});
}

TEST(Parameters, WrongTypeNamesBoth) {
  expect_words(
      message("\"integer radius\" 1", [](Parameters& p) { p.number("radius", 1, "m", ""); }),
      {"scene:2:11", "\"integer\"", "must be \"float\""});
  expect_words(message("\"float c\" 1",
                       [](Parameters& p) { p.rgb("c", Rgb(0), SpectrumUse::Albedo, "", ""); }),
               {"\"float\"", "\"rgb\" or \"spectrum\" or \"blackbody\""});
}

TEST(Parameters, WrongNumberOfValues) {
  const auto read = [](Parameters& p) { p.number("r", 1, "m", ""); };
  expect_words(message("\"float r\" [1 2]", read), {"scene:2:11", "one value, has 2"});
  expect_words(message("\"float r\" []", read), {"one value, has 0"});
  expect_words(
      message("\"point3 p\" [1 2 3 4 5 6]", [](Parameters& p) { p.point("p", {}, "", ""); }),
      {"one value, has 2"});
}

TEST(Parameters, NotFinite) {
  ParameterSet set(1);
  set[0].type = ParameterType::Float;
  set[0].name = "r";
  set[0].floats = {infinity};
  Parameters p(set, {}, "shape \"x\"", nullptr);
  EXPECT_THROW(p.number("r", 1, "", ""), Error);
  EXPECT_THROW(p.numbers("r", "", ""), Error);
}

TEST(Parameters, Choice) {
  constexpr std::array<std::string_view, 2> choices = {"uniform", "power"};
  const auto read = [&](Parameters& p) { p.choice("s", "power", choices, ""); };
  EXPECT_EQ(message("\"string s\" \"uniform\"", read), "accepted");
  expect_words(message("\"string s\" \"unifrom\"", read),
               {"scene:2:11", "\"unifrom\"", "\"uniform\", \"power\"", "did you mean 'uniform'"});
}

TEST(Parameters, FilesMustExist) {
  const auto read = [](Parameters& p) { p.file("filename", ""); };
  expect_words(message("\"string filename\" \"no/such.ply\"", read),
               {"scene:2:11", "does not exist", "no/such.ply"});
  const auto path = std::filesystem::path(::testing::TempDir()) / "pssmlt_parameters_test.ply";
  std::ofstream(path) << "ply";
  Case c("\"string filename\" \"pssmlt_parameters_test.ply\"");
  EXPECT_EQ(c.parameters.file("filename", ""), path.string());
  std::filesystem::remove(path);
}

TEST(Parameters, FailNamesThePlace) {
  expect_words(message("\"float r\" 1", [](Parameters& p) { p.fail("r", "too small"); }),
               {"scene:2:11: shape \"x\": too small"});
  expect_words(message("\"float r\" 1", [](Parameters& p) { p.fail("too small"); }),
               {"scene:2:1: shape \"x\": too small"});
}

TEST(Parameters, DescribingAnswersDefaultsAndRecordsThem) {
  constexpr std::array<std::string_view, 2> choices = {"uniform", "power"};
  std::vector<ParameterDoc> docs;
  Parameters p = Parameters::describing(docs);
  EXPECT_TRUE(p.describing());
  EXPECT_EQ(p.number("radius", 1.5f, "m", "size"), 1.5f);
  EXPECT_EQ(p.choice("s", "power", choices, "which"), "power");
  EXPECT_EQ(p.file("filename", "mesh"), "");
  EXPECT_EQ(p.float_texture("t", 2.f, "", "x")->evaluate(Hit()), 2.f);
  EXPECT_EQ(p.rgb_texture("c", Rgb(1, 0, 0), SpectrumUse::Albedo, "", "x")->evaluate(Hit()),
            Rgb(1, 0, 0));
  EXPECT_FALSE(p.spectrum("c", "", "again").has_value());
  EXPECT_NO_THROW(p.check_all_read());
  ASSERT_EQ(docs.size(), 5u);
  EXPECT_EQ(docs[0].name, "radius");
  EXPECT_EQ(docs[0].type, "float");
  EXPECT_EQ(docs[0].fallback, "1.5");
  EXPECT_EQ(docs[0].unit, "m");
  EXPECT_EQ(docs[0].doc, "size");
  EXPECT_EQ(docs[4].fallback, "1 0 0");
}

}  // namespace
}  // namespace pssmlt
