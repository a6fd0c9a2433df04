// Scenes with materials that light enters, on which techniques must agree.
#pragma once

#include <string>

#include "tests/correctness/room.h"

namespace pssmlt::test {

// Lacquered metal, rough under rough; paint under a coat that scatters, with a smooth boundary;
// wax.
inline AgreementScene layered_scene() {
  return {"layered", std::string(R"(
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 40
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
LightSource "point" "rgb I" [ .4 .6 1.2 ] "point3 from" [ -.6 1.5 -.9 ]
AttributeBegin
  Material "coatedconductor" "float interface.roughness" .4 "float conductor.roughness" .3
    "bool remaproughness" false
  Translate -.45 .4 .2
  Shape "sphere" "float radius" .4
AttributeEnd
AttributeBegin
  Material "coateddiffuse" "rgb reflectance" [ .2 .3 .7 ] "float roughness" 0
    "float thickness" .6 "rgb albedo" [ .9 .6 .3 ] "float g" .3
  Translate .45 .6 -.1
  Shape "sphere" "float radius" .4
AttributeEnd
AttributeBegin
  Material "subsurface" "rgb reflectance" [ .8 .6 .3 ] "rgb mfp" [ .2 .15 .1 ] "float roughness" .4
    "bool remaproughness" false
  Translate 0 .25 -.5
  Shape "sphere" "float radius" .22
AttributeEnd
)"};
}

// Bodies that light crosses beneath their surface: a smooth ball and a rough one beside it, of one
// material, and a bent sheet seen from both sides, whose shading normals are not its geometric
// ones.
inline AgreementScene diffusing_scene() {
  return {"diffusing", std::string(R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 36
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 5
WorldBegin
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
LightSource "point" "rgb I" [ .4 .6 1.2 ] "point3 from" [ -.6 1.5 -.9 ]
Material "subsurface" "string method" "diffusion" "rgb reflectance" [ .8 .6 .3 ]
  "rgb mfp" [ .1 .06 .03 ] "float eta" 1.4
AttributeBegin
  Translate -.45 .45 .2
  Shape "sphere" "float radius" .4
  Translate .55 -.15 -.3
  Shape "sphere" "float radius" .25
AttributeEnd
Material "subsurface" "string method" "diffusion" "rgb sigma_s" [ 9 12 20 ]
  "rgb sigma_a" [ .3 .2 .1 ] "float g" .4 "float roughness" .5 "bool remaproughness" false
AttributeBegin
  Translate .55 .6 .1
  Shape "trianglemesh" "point3 P" [ -.3 -.4 .1  .1 -.4 -.2  .3 -.4 .2  -.3 .4 .1  .1 .4 -.2  .3 .4 .2 ]
    "normal N" [ -.4 .1 -1  .1 .1 -1  .4 .1 -1  -.4 -.1 -1  .1 -.1 -1  .4 -.1 -1 ]
    "integer indices" [ 0 1 3  1 4 3  1 2 4  2 5 4 ]
AttributeEnd
)"};
}

}  // namespace pssmlt::test
