// What a hostile or unlucky user gives the program, as data.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace pssmlt::test {

// Bytes of the file `name` (below the case's folder) that the scene uses.
using Files = std::map<std::string, std::string>;

struct BadInput {
  std::string name;
  std::string scene;               // text of scene.txt; "-": there is no such file
  std::vector<std::string> words;  // all in what the program prints
  std::string place = {};          // "line:column" of the message in scene.txt; "": none
  Files files = {};
  std::vector<std::string> arguments = {};  // after the scene
  bool renders = false;                     // exit code 0 and a finite picture, with a warning
};

// What googletest calls a case.
inline void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

std::vector<BadInput> bad_syntax();
std::vector<BadInput> bad_directives();
std::vector<BadInput> bad_shapes();
std::vector<BadInput> bad_gltf_scenes();
std::vector<BadInput> bad_files();
std::vector<BadInput> bad_usage();
std::vector<BadInput> poor_scenes();  // strange, but with a right picture

// A scene that renders if `extra` does, in 16 x 16 pixels; `extra` starts at line 4, column 1.
inline std::string world(const std::string& extra) {
  return "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
         "Camera \"perspective\"\n"
         "WorldBegin LightSource \"point\" Shape \"sphere\" Translate 0 0 3\n" +
         extra + "\n";
}

// The same for what stands before WorldBegin: at line 1, column 1.
inline std::string options(const std::string& extra) {
  return extra + "\nWorldBegin LightSource \"point\" Shape \"sphere\"\n";
}

}  // namespace pssmlt::test
