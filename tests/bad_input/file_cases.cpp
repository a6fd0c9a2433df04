// Files that are missing, broken or no files; what the command line should not say; and scenes that
// are strange but have a right picture.
#include "tests/bad_input/bad_input.h"

namespace pssmlt::test {
namespace {

std::string textured(const std::string& file) {
  return world("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + file +
               "\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"");
}

BadInput usage(const std::string& name, std::vector<std::string> arguments,
               std::vector<std::string> words) {
  return {name, world(""), std::move(words), "", {}, std::move(arguments)};
}

// Renders `options` over a good scene: refused because of them.
BadInput option(const std::string& name, std::vector<std::string> options,
                std::vector<std::string> words) {
  options.insert(options.begin(), {"scene.txt", "-o", "out.pfm"});
  return usage(name, std::move(options), std::move(words));
}

}  // namespace

std::vector<BadInput> bad_files() {
  return {
      {"NoScene", "-", {"scene.txt"}},
      {"SceneIsFolder", "-", {"directory"}, "", {}, {".", "-o", "out.pfm"}},
      {"BrokenGzip",
       std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03\xff\xff\xff\xff", 14),
       {"scene.txt"}},
      {"NoInclude", world("Include \"none.txt\""), {"cannot open", "none.txt"}, "4:1"},
      {"IncludeOfItself", world("Include \"scene.txt\""), {"being read already"}, "4:1"},
      {"IncludeInCircles",
       world("Include \"a.txt\""),
       {"a.txt:1:1", "being read already"},
       "",
       {{"a.txt", "Include \"scene.txt\""}}},
      {"ImportOfItself", world("Import \"scene.txt\""), {"being read already"}, "4:1"},
      {"NoTexture", textured("none.png"), {"none.png"}, "4:35"},
      {"TextureIsFolder", textured("."), {"directory"}, "4:35"},
      {"EmptyTexture", textured("t.png"), {"t.png"}, "4:35", {{"t.png", ""}}},
      {"TextureIsText", textured("t.exr"), {"t.exr"}, "4:35", {{"t.exr", "no picture"}}},
      {"TextureOfUnknownKind", textured("t.xyz"), {"t.xyz"}, "4:35", {{"t.xyz", "no picture"}}},
      {"PngHeaderAlone",
       textured("t.png"),
       {"t.png"},
       "4:35",
       {{"t.png",
         std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x10\0\0\0\x10\0\x08\2\0\0\0", 29)}}},
      {"HugePfm",
       textured("t.pfm"),
       {"t.pfm"},
       "4:35",
       {{"t.pfm", "PF\n1000000 1000000\n-1\nxxxx"}}},
      {"NoEnvironment",
       world("LightSource \"infinite\" \"string filename\" \"none.exr\""),
       {"none.exr"},
       "4:24"},
      {"EnvironmentIsText",
       world("LightSource \"infinite\" \"string filename\" \"e.exr\""),
       {"e.exr"},
       "4:24",
       {{"e.exr", "no picture"}}},
      {"LampImageIsText",
       world("AreaLightSource \"diffuse\" \"string filename\" \"e.exr\" Shape \"sphere\""),
       {"e.exr"},
       "4:27",
       {{"e.exr", "no picture"}}},
      {"IncludeOfDevice", world("Include \"/dev/zero\""), {"is a device"}, "4:1"},
      {"EnvironmentNotSquare",
       world("LightSource \"infinite\" \"string filename\" \"e.pfm\""),
       {"e.pfm"},
       "4:24",
       {{"e.pfm", "PF\n2 1\n-1\n" + std::string(24, '\0')}}},
      {"EnvironmentNaN",
       world("LightSource \"infinite\" \"string filename\" \"e.pfm\""),
       {"not finite"},
       "4:24",
       {{"e.pfm", "PF\n1 1\n-1\n" + std::string(12, '\xff')}}},
      {"NoSpectrumFile",
       world("Material \"conductor\" \"spectrum eta\" \"none.spd\" Shape \"sphere\""),
       {"none.spd"},
       "4:22"},
  };
}

std::vector<BadInput> bad_usage() {
  return {
      usage("NoArguments", {"render"}, {"required"}),
      usage("UnknownOption", {"scene.txt", "--colour", "red"}, {"--colour"}),
      usage("TwoScenes", {"scene.txt", "scene.txt"}, {"scene.txt"}),
      usage("UnknownKind", {"plugins", "integrater"}, {"there is no kind \"integrater\""}),
      usage("UnknownPlugin", {"plugins", "integrator", "paht"}, {"did you mean"}),
      usage("InfoOfNothing", {"info", "none.txt"}, {"none.txt"}),
      usage("UnknownFormat", {"scene.txt", "-o", "out.xyz"}, {"xyz"}),
      usage("NoOutputFolder", {"scene.txt", "-o", "none/out.exr"}, {"cannot write"}),
      usage("OutputIsFolder", {"scene.txt", "-o", "."}, {"image format"}),
      usage("LayersWithoutExr", {"scene.txt", "-o", "out.pfm", "--aux", "albedo"}, {"EXR"}),
      option("CropOfWords", {"--crop", "a,b,c,d"}, {"a,b,c,d", "window"}),
      option("CropOfThree", {"--crop", "0,1,2"}, {"0,1,2", "window"}),
      option("CropOutside", {"--crop", "100,200,0,5"}, {"no pixels"}),
      option("CropBackwards", {"--crop", "9,3,0,5"}, {"no pixels"}),
      option("CropOverflow", {"--crop", "0,99999999999,0,5"}, {"window"}),
      option("SizeOfWords", {"--size", "big"}, {"big", "640x480"}),
      option("SizeZero", {"--size", "0x16"}, {"no pixels"}),
      option("SizeHuge", {"--size", "100000x100000"}, {"too large"}),
      option("ScaleNegative", {"--scale", "-1"}, {"--scale"}),
      option("ScaleHuge", {"--scale", "1e30"}, {"too large"}),
      option("ScaleNaN", {"--scale", "nan"}, {"scale"}),
      option("TimeOfWords", {"--time", "abc"}, {"abc", "60s"}),
      option("TimeNegative", {"--time", "-5s"}, {"-5s"}),
      option("TimeZero", {"--time", "0s"}, {"0s"}),
      option("SppZero", {"--spp", "0"}, {"--spp"}),
      option("SppNaN", {"--spp", "nan"}, {"samples per pixel"}),
      option("ErrorZero", {"--target-error", "0"}, {"--target-error"}),
      option("ThreadsNegative", {"--threads", "-1"}, {"--threads"}),
      option("ThreadsTooMany", {"--threads", "1000000"}, {"--threads"}),
      option("SeedNegative", {"--seed", "-1"}, {"--seed"}),
      option("SetNonsense", {"--set", "nonsense"}, {"nonsense", "integrator.maxdepth=8"}),
      option("SetUnknownOwner", {"--set", "integrater.maxdepth=8"}, {"integrater"}),
      option("SetUnknownName", {"--set", "integrator.maxdeth=8"}, {"maxdeth", "did you mean"}),
      option("SetWord", {"--set", "integrator.maxdepth=many"}, {"many", "number"}),
      option("UnknownIntegratorOption", {"--integrator", "paht"}, {"paht", "did you mean"}),
      option("UnknownSamplerOption", {"--sampler", "metropolis"}, {"metropolis"}),
      option("PixelOutside", {"--pixel", "99,99"}, {"99,99"}),
      option("ReplayNonsense", {"--replay", "nonsense"}, {"nonsense", "replay key"}),
      option("UnknownAux", {"--aux", "albido"}, {"albido"}),
      option("CheckpointNowhere", {"--checkpoint", "none/state"}, {"none/state"}),
      option("JsonNowhere", {"--json", "none/out.json"}, {"none/out.json"}),
      {"ResumeFromText",
       world(""),
       {"not a checkpoint"},
       "",
       {{"state", std::string(500, 'x')}},
       {"scene.txt", "-o", "out.pfm", "--checkpoint", "state", "--resume"}},
      {"ResumeFromEmptyFile",
       world(""),
       {"state"},
       "",
       {{"state", ""}},
       {"scene.txt", "-o", "out.pfm", "--checkpoint", "state", "--resume"}},
  };
}

std::vector<BadInput> poor_scenes() {
  const std::string small = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n";
  const auto poor = [](const std::string& name, const std::string& scene,
                       std::vector<std::string> words) {
    return BadInput{name, scene, std::move(words), "", {}, {}, true};
  };
  const std::string flat =
      "Shape \"trianglemesh\" \"integer indices\" [0 0 1] \"point3 P\" "
      "[0 0 0 1 1 1]";
  return {
      poor("NoLight", small + "WorldBegin Shape \"sphere\"", {"no light"}),
      poor("NoShape", small + "WorldBegin LightSource \"point\"", {"no shapes"}),
      poor("NoCamera", small + "WorldBegin LightSource \"point\" Shape \"sphere\"", {"no camera"}),
      poor("Nothing", small + "WorldBegin", {"no light"}),
      poor("DarkUnderChains", small + "Sampler \"pssmlt\" WorldBegin Shape \"sphere\"", {"black"}),
      poor("BlackLight", world("LightSource \"point\" \"rgb I\" [0 0 0]"), {}),
      poor("NegativeLight", world("LightSource \"point\" \"rgb I\" [-1 2 3]"), {"clipped"}),
      poor("LampWithoutArea", world("AreaLightSource \"diffuse\"\n" + flat), {}),
      poor("FlatTriangle", world(flat), {}),
      poor("FlatPatch", world("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 0 0 0 0 0 0 0 0 0]"), {}),
      poor("FarLight", world("LightSource \"point\" \"point3 from\" [1e30 0 0]"), {}),
      poor("TinyScene", world("Scale 1e-20 1e-20 1e-20 Shape \"sphere\""), {}),
      poor("HugeSphere", world("Shape \"sphere\" \"float radius\" 1e17"), {}),
      poor("MirroredMesh", world("Scale -1 1 1 " + flat), {}),
      poor("EmptyObject", world("ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\""), {}),
      poor("LampInObject",
           world("ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"sphere\" ObjectEnd "
                 "ObjectInstance \"o\""),
           {}),
      poor("LampInMovingObject",
           world("ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"sphere\" ObjectEnd "
                 "ActiveTransform EndTime Translate 1 0 0 ObjectInstance \"o\""),
           {"not emitting"}),
      poor("EmissiveInterface",
           world("Material \"interface\" AreaLightSource \"diffuse\" Shape \"sphere\""),
           {"emits nothing"}),
      poor("BrightSurface",
           world("Material \"diffuse\" \"rgb reflectance\" [5 5 5] Shape \"sphere\""), {}),
      poor("HugeLight", world("LightSource \"point\" \"rgb I\" [1e38 1e38 1e38]"), {}),
      poor("UnknownOption", "Option \"bool unheardof\" true\n" + world(""), {"unheardof"}),
  };
}

}  // namespace pssmlt::test
