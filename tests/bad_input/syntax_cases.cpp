// Text that is no scene. The parser's own tests hold every rule; here are those that reach users.
#include "tests/bad_input/bad_input.h"

namespace pssmlt::test {
namespace {

std::string many(const std::string& text, size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (size_t i = 0; i < count; ++i) result += text;
  return result;
}

std::string garbage() {
  std::string bytes;
  uint32_t state = 1;
  for (int i = 0; i < 5000; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes += static_cast<char>(state >> 24);
  }
  return bytes;
}

}  // namespace

std::vector<BadInput> bad_syntax() {
  return {
      {"EmptyFile", "", {"before WorldBegin"}, "1:1"},
      {"OnlyComment", "# nothing\n", {"before WorldBegin"}, "2:1"},
      {"ZeroByte", std::string("\0", 1), {"scene.txt:1:1"}},
      {"Garbage", garbage(), {"scene.txt:1:1: "}},
      {"UnknownDirective", world("Shpae \"sphere\""), {"Shpae", "did you mean 'Shape'"}, "4:1"},
      {"OpenString", world("Shape \"sphere"), {"does not end"}, "4:7"},
      {"OpenList", world("Shape \"sphere\" \"float radius\" [ 1"), {"']' is missing"}, "4:16"},
      {"ListWithinList", world("Shape \"sphere\" \"float radius\" [[1]]"), {"number"}, "4:32"},
      {"ManyBrackets", world(many("[", 300000)), {"expected a directive"}, "4:1"},
      {"DeepBlocks", world(many("AttributeBegin ", 200000)), {"AttributeBegin without"}},
      {"LongWord", world(many("x", 5000000)), {"unknown directive"}, "4:1"},
      {"NoValue", world("Shape \"sphere\" \"float radius\""), {"no value"}, "4:16"},
      {"WordForNumber", world("Shape \"sphere\" \"float radius\" big"), {"number", "big"}, "4:31"},
      {"NaN", world("Shape \"sphere\" \"float radius\" nan"), {"finite", "nan"}, "4:31"},
      {"Infinity", world("Translate inf 0 0"), {"finite"}, "4:11"},
      {"NegativeInfinity", world("LightSource \"point\" \"rgb I\" [1 -inf 1]"), {"finite"}, "4:32"},
      {"HugeNumber", world("Shape \"sphere\" \"float radius\" 1e99"), {"1e99"}, "4:31"},
      {"HugeInteger",
       options("Film \"rgb\" \"integer xresolution\" 99999999999"),
       {"32 bits"},
       "1:34"},
      {"UnknownType",
       world("Shape \"sphere\" \"flaot radius\" 1"),
       {"did you mean 'float'"},
       "4:16"},
      {"TwoNumbersForPoint",
       world("LightSource \"point\" \"point3 from\" [1 2]"),
       {"multiple of 3"},
       "4:21"},
      {"Twice", world("Shape \"sphere\" \"float radius\" 1 \"float radius\" 2"), {"twice"}, "4:33"},
      {"SingularTransform", world("Scale 0 1 1 Shape \"sphere\""), {"singular"}, "4:1"},
      {"OverflowingTransform",
       world("Scale 1e300 1 1 Scale 1e300 1 1 Shape \"sphere\""),
       {"singular"},
       "4:17"},
      {"UnbalancedBlocks", world("AttributeEnd"), {"AttributeEnd without"}, "4:1"},
      {"DirectiveTooLate", world("Film \"rgb\""), {"before WorldBegin"}, "4:1"},
      {"DirectiveTooEarly", options("Shape \"sphere\""), {"after WorldBegin"}, "1:1"},
  };
}

std::vector<BadInput> bad_directives() {
  const auto size = [](const std::string& x, const std::string& y) {
    return options("Film \"rgb\" \"integer xresolution\" " + x + " \"integer yresolution\" " + y);
  };
  return {
      {"NoPixels", size("0", "0"), {"no pixels", "0 x 0"}, "1:1"},
      {"NegativeSize", size("-5", "10"), {"no pixels"}, "1:1"},
      {"HugePicture", size("100000", "100000"), {"too large"}, "1:1"},
      {"HugestPicture", size("2147483647", "2147483647"), {"too large"}, "1:1"},
      {"EmptyCrop", options("Film \"rgb\" \"float cropwindow\" [.5 .5 0 1]"), {"no pixels"}, "1:1"},
      {"ShortCrop", options("Film \"rgb\" \"float cropwindow\" [0 1]"), {"4 numbers"}, "1:12"},
      {"UnknownFilm", options("Film \"polaroid\""), {"film \"polaroid\"", "not supported"}, "1:1"},
      {"UnknownIntegrator", options("Integrator \"paht\""), {"did you mean", "path"}, "1:1"},
      {"UnknownSampler", options("Sampler \"soboll\""), {"did you mean", "sobol"}, "1:1"},
      {"UnknownCamera",
       options("Camera \"fisheye\""),
       {"camera \"fisheye\"", "not supported"},
       "1:1"},
      {"UnknownFilter", options("PixelFilter \"lanczos\""), {"filter \"lanczos\""}, "1:1"},
      {"UnknownShape", world("Shape \"teapot\""), {"shape \"teapot\"", "not supported yet"}, "4:1"},
      {"UnknownLight", world("LightSource \"laser\""), {"light \"laser\""}, "4:1"},
      {"UnknownAreaLight", world("AreaLightSource \"glow\" Shape \"sphere\""), {"\"glow\""}, "4:1"},
      {"UnknownMaterial",
       world("Material \"marzipan\" Shape \"sphere\""),
       {"material \"marzipan\"", "not supported yet"},
       "4:1"},
      {"UnknownTexture",
       world("Texture \"t\" \"float\" \"ptex\" Material \"dielectric\" \"texture roughness\" "
             "\"t\" Shape \"sphere\""),
       {"texture \"ptex\""},
       "4:1"},
      {"Medium",
       options("MakeNamedMedium \"fog\" \"string type\" \"steam\" "
               "MediumInterface \"\" \"fog\" Camera \"perspective\""),
       {"medium \"steam\"", "not supported yet"},
       "1:1"},
      {"Motion",
       world("ActiveTransform EndTime Translate 1 0 0 ActiveTransform All "
             "LightSource \"point\""),
       {"light sources cannot move"},
       "4:61"},
      {"NameWithSlashes",
       world("Material \"../../../etc/passwd\" Shape \"sphere\""),
       {"not a name of a material"},
       "4:1"},
      {"EmptyName", world("Material \"\" Shape \"sphere\""), {"Material needs a type"}, "4:1"},
      {"UnknownParameter",
       world("Shape \"sphere\" \"float radiu\" 1"),
       {"unknown parameter", "did you mean", "radius"},
       "4:16"},
      {"WrongParameterType",
       world("Shape \"sphere\" \"string radius\" \"big\""),
       {"radius"},
       "4:16"},
      {"TwoValuesForOne", world("Shape \"sphere\" \"float radius\" [1 2]"), {"radius"}, "4:16"},
      {"NegativeDepth",
       options("Integrator \"path\" \"integer maxdepth\" -1"),
       {"maxdepth"},
       "1:19"},
      {"HugeDepth",
       options("Integrator \"bdpt\" \"integer maxdepth\" 2147483647"),
       {"maxdepth"},
       "1:19"},
      {"NoSamples",
       options("Sampler \"sobol\" \"integer pixelsamples\" 0"),
       {"pixelsamples"},
       "1:17"},
      {"HugeStrata",
       options("Sampler \"stratified\" \"integer xsamples\" 2000000000 \"integer ysamples\" "
               "2000000000"),
       {"2^24"},
       "1:1"},
      {"NoBootstrap",
       options("Sampler \"pssmlt\" \"integer bootstrapsamples\" 0"),
       {"bootstrapsamples", "positive"},
       "1:18"},
      {"TooManyChains",
       options("Sampler \"pssmlt\" \"integer chains\" 2000000000"),
       {"chains"},
       "1:18"},
      {"NoLargeSteps",
       options("Sampler \"pssmlt\" \"float largestepprobability\" -1"),
       {"largestepprobability"},
       "1:18"},
      {"ClampUnderChains",
       options("Film \"rgb\" \"float maxcomponentvalue\" 10 Sampler \"pssmlt\""),
       {"maxcomponentvalue", "Markov chain"},
       "",
       {},
       {"scene.txt", "-o", "out.pfm", "--honour-clamp"}},
      {"BrokenPathExpression",
       options("Integrator \"path\" \"string paths\" \"E(D\""),
       {"path expression"},
       "1:19"},
      {"FieldOfView", options("Camera \"perspective\" \"float fov\" 180"), {"fov", "180"}, "1:22"},
      {"WideFilter", options("PixelFilter \"box\" \"float xradius\" 100"), {"64"}, "1:1"},
      {"NoFilterRadius", options("PixelFilter \"box\" \"float xradius\" 0"), {"positive"}, "1:19"},
      {"LightWithoutDirection",
       world("LightSource \"distant\" \"point3 from\" [1 1 1] \"point3 to\" [1 1 1]"),
       {"must differ"},
       "4:45"},
      {"WideSpot", world("LightSource \"spot\" \"float coneangle\" 200"), {"coneangle"}, "4:20"},
      {"NoSuchMaterial", world("NamedMaterial \"glod\" Shape \"sphere\""), {"\"glod\""}, "4:1"},
      {"MixOfNothing",
       world("Material \"mix\" \"string materials\" [\"a\" \"b\"] Shape \"sphere\""),
       {"no material is named \"a\""},
       "4:1"},
      {"MixOfItself",
       world("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"] "
             "NamedMaterial \"m\" Shape \"sphere\""),
       {"contains itself"},
       "4:1"},
      {"NoSuchTexture",
       world("Material \"diffuse\" \"texture reflectance\" \"none\" "
             "Shape \"sphere\""),
       {"texture is named \"none\""},
       "4:20"},
      {"TextureOfWrongKind",
       world("Texture \"t\" \"float\" \"constant\" Material \"diffuse\" \"texture reflectance\" "
             "\"t\" Shape \"sphere\""),
       {"not a spectrum texture"}},
      {"TextureOfItself",
       world("Texture \"t\" \"float\" \"scale\" \"texture tex\" \"t\" Material \"dielectric\" "
             "\"texture roughness\" \"t\" Shape \"sphere\""),
       {"\"t\""}},
      {"UnknownMetal",
       world("Material \"conductor\" \"spectrum eta\" \"metal-Unobtainium-eta\" Shape \"sphere\""),
       {"metal-Unobtainium-eta"}},
      {"ObjectOfItself",
       world("ObjectBegin \"o\" ObjectInstance \"o\" ObjectEnd ObjectInstance \"o\""),
       {"would contain itself"},
       "4:17"},
      {"ObjectsInEachOther",
       world("ObjectBegin \"a\" ObjectInstance \"b\" ObjectEnd\n"
             "ObjectBegin \"b\" ObjectInstance \"a\" ObjectEnd ObjectInstance \"a\""),
       {"\"a\" would contain itself"},
       "5:17"},
      {"UnknownObjectInside",
       world("ObjectBegin \"a\" ObjectInstance \"teapot\" ObjectEnd"),
       {"teapot", "not defined"},
       "4:17"},
      {"UnknownObject", world("ObjectInstance \"teapot\""), {"teapot", "not defined"}, "4:1"},
  };
}

}  // namespace pssmlt::test
