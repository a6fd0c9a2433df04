// What scenes on which techniques must agree are made of.
#pragma once

#include <string>

namespace pssmlt::test {

struct AgreementScene {
  const char* name;
  std::string text;
};

// Chains as short as the small pictures, with all kinds of steps.
inline std::string chains(const char* large_step_probability) {
  return std::string(R"(Sampler "pssmlt" "integer bootstrapsamples" 8192 "integer chains" 64
  "float filmprobability" 0.1 "float streamprobability" 0.2
  "float largestepprobability" )") +
         large_step_probability + "\n";
}

// A room 2 x 2 x 2 without a front wall; checkered floor. Uses the materials in force.
inline const char* const room = R"(
AttributeBegin
  Texture "checks" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4
    "rgb tex1" [ .7 .6 .2 ] "rgb tex2" [ .15 .2 .4 ]
  Material "diffuse" "texture reflectance" "checks"
  Shape "bilinearmesh" "point3 P" [ -1 0 1  1 0 1  -1 0 -1  1 0 -1 ]
    "point2 uv" [ 0 0  1 0  0 1  1 1 ]
  Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
  Shape "bilinearmesh" "point3 P" [ -1 0 1  1 0 1  -1 2 1  1 2 1 ]
  Shape "bilinearmesh" "point3 P" [ -1 2 1  1 2 1  -1 2 -1  1 2 -1 ]
  Material "diffuse" "rgb reflectance" [ .6 .2 .1 ]
  Shape "bilinearmesh" "point3 P" [ -1 0 1  -1 0 -1  -1 2 1  -1 2 -1 ]
  Material "diffuse" "rgb reflectance" [ .1 .5 .2 ]
  Shape "bilinearmesh" "point3 P" [ 1 0 1  1 0 -1  1 2 1  1 2 -1 ]
AttributeEnd
)";

}  // namespace pssmlt::test
