// Malformed scenes: each must be refused at the right place with words that say why.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "core/scene/parser.h"

namespace pssmlt {
namespace {

namespace fs = std::filesystem;

struct Bad {
  const char* name;
  const char* text;
  const char* place;               // line:column
  std::vector<const char*> words;  // all in the message
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

class BadScene : public ::testing::TestWithParam<Bad> {};

TEST_P(BadScene, IsRefused) {
  const Bad& bad = GetParam();
  try {
    parse_string(bad.text, "scene");
    FAIL() << "accepted: " << bad.text;
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(std::string("scene:") + bad.place + ": ", 0), 0u) << what;
    for (const char* word : bad.words)
      EXPECT_NE(what.find(word), std::string::npos) << "'" << word << "' is not in: " << what;
  }
}

const Bad bad_scenes[] = {
    {"UnknownDirective", "WorldBegin\nShpae \"a\"", "2:1", {"Shpae", "did you mean 'Shape'"}},
    {"StringForDirective", "\"Shape\"", "1:1", {"expected a directive", "Shape"}},
    {"BracketForDirective", "WorldBegin ]", "1:12", {"expected a directive", "']'"}},
    {"NoName", "WorldBegin Shape sphere", "1:18", {"Shape", "string in quotes"}},
    {"NameAtEnd", "WorldBegin Shape", "1:17", {"Shape", "string in quotes"}},
    {"OpenString", "WorldBegin\nShape \"a\n\"", "2:7", {"does not end"}},
    {"UnknownEscape", "WorldBegin Shape \"a\\q\"", "1:20", {"escape"}},
    {"UnknownType",
     "WorldBegin Shape \"a\" \"flaot r\" 1",
     "1:22",
     {"type \"flaot\"", "did you mean 'float'"}},
    {"OldType", "WorldBegin Shape \"a\" \"color r\" [1 1 1]", "1:22", {"pbrt-v3", "rgb"}},
    {"NoParameterName", "WorldBegin Shape \"a\" \"float\" 1", "1:22", {"type name"}},
    {"EmptyParameter", "WorldBegin Shape \"a\" \"\" 1", "1:22", {"type name"}},
    {"NameWithSpace", "WorldBegin Shape \"a\" \"float r s\" 1", "1:22", {"no spaces"}},
    {"NoValue", "WorldBegin Shape \"a\" \"float r\"", "1:22", {"float r", "no value"}},
    {"OpenList", "WorldBegin\nShape \"a\" \"float r\" [ 1 2", "2:11", {"']' is missing"}},
    {"ListRunsIntoDirective",
     "WorldBegin Shape \"a\" \"float r\" [ 1\nShape",
     "2:1",
     {"expected a number", "'Shape'"}},
    {"StringForNumber",
     "WorldBegin Shape \"a\" \"float r\" \"1\"",
     "1:32",
     {"float r", "expected a number", "string"}},
    {"WordForNumber", "WorldBegin Shape \"a\" \"float r\" true", "1:32", {"expected a number"}},
    {"NumberForString", "WorldBegin Shape \"a\" \"string r\" 1", "1:33", {"string in quotes"}},
    {"NumberForTexture", "WorldBegin Shape \"a\" \"texture r\" 1", "1:34", {"string in quotes"}},
    {"FractionForInteger",
     "WorldBegin Shape \"a\" \"integer r\" [1 1.5]",
     "1:37",
     {"expected an integer", "1.5"}},
    {"HugeInteger", "WorldBegin Shape \"a\" \"integer r\" 3000000000", "1:34", {"32 bits"}},
    {"NumberForBool", "WorldBegin Shape \"a\" \"bool r\" 1", "1:31", {"true or false"}},
    {"NaN", "WorldBegin Shape \"a\" \"float r\" [0 nan]", "1:35", {"finite", "nan"}},
    {"Infinity", "WorldBegin Shape \"a\" \"float r\" -inf", "1:32", {"finite", "-inf"}},
    {"HugeFloat", "WorldBegin Shape \"a\" \"float r\" 1e39", "1:32", {"single precision", "1e39"}},
    {"BrokenNumber", "WorldBegin Shape \"a\" \"float r\" 1.2.3", "1:32", {"number", "1.2.3"}},
    {"TwoNumbersForPoint",
     "WorldBegin Shape \"a\" \"point3 p\" [1 2]",
     "1:22",
     {"2 numbers", "multiple of 3"}},
    {"FourNumbersForRgb", "WorldBegin Shape \"a\" \"rgb c\" [1 2 3 4]", "1:22", {"multiple of 3"}},
    {"OddSpectrum", "WorldBegin Shape \"a\" \"spectrum c\" [1 2 3]", "1:22", {"multiple of 2"}},
    {"MixedSpectrum", "WorldBegin Shape \"a\" \"spectrum c\" [1 \"x\"]", "1:38", {"number"}},
    {"TwiceTheSameName",
     "WorldBegin Shape \"a\"\n \"float r\" 1\n \"integer r\" 2",
     "3:2",
     {"\"r\"", "twice", "scene:2:2"}},
    {"NestedBrackets", "WorldBegin Shape \"a\" \"float r\" [[1]]", "1:33", {"expected a number"}},
    {"FewNumbers", "Translate 1 2\nWorldBegin", "2:1", {"Translate", "3 finite numbers"}},
    {"OpenMatrix",
     "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1]",
     "1:44",
     {"Transform", "']'", "16"}},
    {"NaNTransform", "Scale 1 nan 1", "1:9", {"Scale", "finite"}},
    {"SingularMatrix",
     "WorldBegin\nTransform [1 0 0 0 2 0 0 0 0 0 1 0 0 0 0 1]\nShape \"a\"",
     "2:1",
     {"singular", "scene:3:1"}},
    {"SingularScale", "WorldBegin AttributeBegin\nScale 1 0 1 Shape \"a\"", "2:1", {"singular"}},
    {"SingularCamera", "Scale 0 0 0 Camera \"perspective\"", "1:1", {"singular"}},
    {"Overflow", "WorldBegin Scale 1e300 1 1 Scale 1e300 1 1 Shape \"a\"", "1:28", {"singular"}},
    {"NoAxis", "Rotate 90 0 0 0", "1:1", {"axis"}},
    {"LookAtNothing", "LookAt 1 2 3 1 2 3 0 1 0", "1:1", {"LookAt", "singular"}},
    {"LookAlongUp", "LookAt 0 0 0 0 5 0 0 1 0", "1:1", {"LookAt", "up"}},
    {"WrongActive", "ActiveTransform Start", "1:17", {"StartTime"}},
    {"TimesSwapped", "TransformTimes 1 0", "1:1", {"TransformTimes"}},
    {"NoCoordinates", "CoordSysTransform \"camera\"", "1:1", {"camera", "not defined"}},
    {"FilmInWorld", "WorldBegin\n Film \"rgb\"", "2:2", {"Film", "before WorldBegin"}},
    {"ShapeInOptions", "Shape \"sphere\"", "1:1", {"Shape", "after WorldBegin"}},
    {"TwoWorlds", "WorldBegin WorldBegin", "1:12", {"WorldBegin", "before"}},
    {"NoWorld", "Film \"rgb\"\n", "2:1", {"before WorldBegin"}},
    {"OldWorldEnd", "WorldBegin\nWorldEnd", "2:1", {"pbrt-v3", "WorldEnd"}},
    {"OpenAttribute",
     "WorldBegin\nAttributeBegin\nShape \"a\"",
     "2:1",
     {"AttributeBegin without AttributeEnd"}},
    {"LoneAttributeEnd", "WorldBegin AttributeEnd", "1:12", {"AttributeEnd without"}},
    {"CrossedNesting",
     "WorldBegin AttributeBegin ObjectBegin \"o\" AttributeEnd",
     "1:43",
     {"AttributeEnd closes the ObjectBegin", "scene:1:27"}},
    {"OpenTransform", "TransformBegin WorldBegin", "1:1", {"TransformBegin without"}},
    {"ObjectInObject",
     "WorldBegin ObjectBegin \"o\" ObjectBegin \"p\"",
     "1:28",
     {"ObjectBegin inside", "\"o\""}},
    {"InstanceInObject",
     "WorldBegin ObjectBegin \"o\" ObjectInstance \"o\" ObjectEnd",
     "1:28",
     {"contain itself", "\"o\""}},
    {"LoneObjectEnd", "WorldBegin ObjectEnd", "1:12", {"ObjectEnd without"}},
    {"ObjectTwice",
     "WorldBegin ObjectBegin \"o\" ObjectEnd\nObjectBegin \"o\"",
     "2:1",
     {"already defined", "scene:1:12"}},
    {"NoObject",
     "WorldBegin ObjectBegin \"teapot\" ObjectEnd ObjectInstance \"taepot\"",
     "1:43",
     {"taepot", "did you mean 'teapot'"}},
    {"NoMaterial",
     "WorldBegin MakeNamedMaterial \"gold\" \"string type\" \"conductor\"\nNamedMaterial \"glod\"",
     "2:1",
     {"glod", "did you mean 'gold'"}},
    {"MaterialTwice",
     "WorldBegin MakeNamedMaterial \"m\" \"string type\" \"a\"\n"
     "MakeNamedMaterial \"m\" \"string type\" \"b\"",
     "2:1",
     {"already defined", "scene:1:12"}},
    {"MaterialWithoutType", "WorldBegin MakeNamedMaterial \"m\"", "1:12", {"string type"}},
    {"MaterialTypeNoString",
     "WorldBegin MakeNamedMaterial \"m\" \"float type\" 1",
     "1:34",
     {"type", "string"}},
    {"MediumTwice",
     "MakeNamedMedium \"m\" \"string type\" \"a\"\nMakeNamedMedium \"m\" \"string type\" \"b\"",
     "2:1",
     {"already defined", "scene:1:1"}},
    {"NoMedium", "MediumInterface \"\" \"fog\" WorldBegin", "1:1", {"fog", "not defined"}},
    {"MediumWithoutName", "MakeNamedMedium \"\" \"string type\" \"a\"", "1:1", {"name"}},
    {"TextureTwice",
     "WorldBegin Texture \"t\" \"float\" \"constant\"\nTexture \"t\" \"float\" \"scale\"",
     "2:1",
     {"already defined", "scene:1:12"}},
    {"TextureType",
     "WorldBegin Texture \"t\" \"color\" \"constant\"",
     "1:12",
     {"color", "spectrum"}},
    {"TextureWithoutClass",
     "WorldBegin Texture \"t\" \"float\" Shape",
     "1:32",
     {"Texture", "string in quotes"}},
    {"ColorSpaceUnknown", "ColorSpace \"sgrb\"", "1:1", {"sgrb", "did you mean 'srgb'"}},
    {"AttributeTarget", "Attribute \"shap\" \"float r\" 1", "1:1", {"did you mean 'shape'"}},
    {"LayerInWorld", "WorldBegin LayerBegin \"a\"", "1:12", {"before WorldBegin"}},
    {"LayerInLayer", "LayerBegin \"a\" LayerBegin \"b\"", "1:16", {"between LayerBegin"}},
    {"FilmInLayer", "LayerBegin \"a\" Film \"rgb\"", "1:16", {"Film", "between LayerBegin"}},
    {"OpenLayer", "LayerBegin \"a\"\nWorldBegin", "2:1", {"LayerEnd is missing", "scene:1:1"}},
    {"LoneLayerEnd", "LayerEnd", "1:1", {"LayerEnd without"}},
    {"LayerTwice", "LayerBegin \"a\" LayerEnd LayerBegin \"a\"", "1:25", {"already defined"}},
    {"LayerWithoutName", "LayerBegin \"\"", "1:1", {"name"}},
    {"IncludeInText", "Include \"/etc/passwd\"", "1:1", {"Include", "not read from a file"}},
    {"ImportBeforeWorld", "Import \"x\"", "1:1", {"after WorldBegin"}},
    {"OptionType", "Option \"flaot x\" 1", "1:1", {"flaot"}},
    {"OptionWithoutValue", "Option \"x\"", "1:11", {"number"}},
};

INSTANTIATE_TEST_SUITE_P(Parser, BadScene, ::testing::ValuesIn(bad_scenes),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(BadScenes, MessageQuotesTheLineUnderlined) {
  try {
    parse_string("WorldBegin\n\tShape \"a\" \"float r\" x\n", "scene");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "scene:2:22: parameter \"float r\": expected a number, found 'x'\n"
                 "  \tShape \"a\" \"float r\" x\n"
                 "  \t                    ^");
  }
}

TEST(BadScenes, DuplicatesAreFoundAmongManyParameters) {
  std::string text = "WorldBegin Shape \"a\"";
  for (int i = 0; i < 1000; ++i) text += "\n\"float p" + std::to_string(i) + "\" 1";
  EXPECT_NO_THROW(parse_string(text, "scene"));
  try {
    parse_string(text + "\n\"float p500\" 2", "scene");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("scene:1002:1: ", 0), 0u) << error.what();
  }
}

// A small fuzzer that always runs; the thorough one is tests/fuzz. Whatever bytes are changed, cut
// or doubled, the parser returns or throws an Error.
TEST(BadScenes, RandomDamageNeverCrashes) {
  const std::string whole = R"(LookAt 0 0 -5 0 0 0 0 1 0 Camera "perspective" "float fov" [ 39.5 ]
    LayerBegin "a" Sampler "sobol" Integrator "path" LayerEnd
    MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .1 .2 .3 ]
    WorldBegin AttributeBegin Translate 1 2 3 Rotate 30 1 0 0 ActiveTransform EndTime Scale 1 2 3
    Attribute "shape" "bool x" true Material "diffuse" "spectrum reflectance" [400 .5 700 .6]
    Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1 0 0 0 1 0] AttributeEnd
    ObjectBegin "o" Shape "sphere" ObjectEnd ObjectInstance "o" # end
    Texture "t" "float" "constant" "float value" 1e-3 NamedMaterial "m"
    MakeNamedMaterial "m" "string type" "conduc\"tor")";
  std::mt19937 random(7);
  const auto below = [&random](size_t n) { return static_cast<size_t>(random() % n); };
  const std::string bytes("\"[]# \n\\.-+e09nA\0\xff", 17);
  for (int i = 0; i < 20000; ++i) {
    std::string text = whole;
    for (size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
      const size_t at = below(text.size());
      const size_t kind = below(4);
      if (kind == 0)
        text[at] = bytes[below(bytes.size())];
      else if (kind == 1)
        text.erase(at, 1 + below(20));
      else if (kind == 2)
        text.insert(at, text.substr(below(text.size()), below(30)));
      else
        text.resize(at + 1);
    }
    try {
      parse_string(text, "scene");
    } catch (const Error&) {
    }
  }
}

class BadFiles : public ::testing::Test {
 protected:
  BadFiles()
      : folder_(fs::path(::testing::TempDir()) /
                ("pssmlt_bad_" +
                 std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::create_directories(folder_);
  }
  ~BadFiles() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  static std::string message(const std::string& path) {
    try {
      parse_file(path, nullptr);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }
  fs::path folder_;
};

TEST_F(BadFiles, Missing) {
  EXPECT_NE(message((folder_ / "none.pbrt").string()).find("cannot open"), std::string::npos);
  EXPECT_NE(message(folder_.string()).find("directory"), std::string::npos);
  const auto path = write("a.pbrt", "WorldBegin\nInclude \"none.pbrt\"");
  EXPECT_EQ(message(path).rfind(path + ":2:1: cannot open", 0), 0u) << message(path);
}

TEST_F(BadFiles, RecursiveInclude) {
  const auto a = write("a.pbrt", "WorldBegin Include \"b.pbrt\"");
  const auto b = write("b.pbrt", "\nInclude \"./a.pbrt\"");
  EXPECT_EQ(message(a).rfind(b + ":2:1: Include", 0), 0u) << message(a);
  EXPECT_NE(message(a).find("being read already"), std::string::npos);
}

TEST_F(BadFiles, ErrorInIncludedFileNamesThatFile) {
  const auto a = write("a.pbrt", "WorldBegin\nInclude \"b.pbrt\"\nShape \"x\"");
  const auto b = write("b.pbrt", "NamedMaterial \"none\"\n");
  EXPECT_EQ(message(a), b + ":1:1: named material \"none\" is not defined\n"
                            "  NamedMaterial \"none\"\n  ^");
}

TEST_F(BadFiles, ImportMustBeBalanced) {
  const auto a = write("a.pbrt", "WorldBegin AttributeBegin Import \"b.pbrt\"");
  const auto b = write("b.pbrt", "AttributeEnd");
  EXPECT_EQ(message(a).rfind(b + ":1:1: AttributeEnd without", 0), 0u) << message(a);
  write("b.pbrt", "AttributeBegin");
  EXPECT_EQ(message(a).rfind(b + ":1:1: AttributeBegin without", 0), 0u) << message(a);
}

}  // namespace
}  // namespace pssmlt
