// Scenes with media and with things that move, on which techniques must agree.
#pragma once

#include <string>

#include "tests/correctness/room.h"

namespace pssmlt::test {

// A room full of fog, behind a pane that cannot be seen, with a lamp in it; a ball of a coloured,
// glowing medium inside rough glass; smoke from a grid that cannot be seen otherwise. The camera
// and the lights without a size are outside: what is connected to a point right beside it varies
// without bounds.
inline AgreementScene fog_scene() {
  return {"fog", std::string(R"(
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 40
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .02 .02 .03 ]
  "rgb sigma_s" [ .15 .2 .3 ] "float g" .4
AttributeBegin
  MediumInterface "" "fog"
  Material "interface"
  Shape "bilinearmesh" "point3 P" [ -1 0 -1  1 0 -1  -1 2 -1  1 2 -1 ]
AttributeEnd
MediumInterface "fog" "fog"
MakeNamedMedium "milk" "string type" "homogeneous" "rgb sigma_a" [ .2 .1 .05 ]
  "rgb sigma_s" [ 1 2 3 ] "float g" -.2 "rgb Le" [ .3 .2 .1 ]
MakeNamedMedium "smoke" "string type" "rgbgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
  "point3 p0" [ -.35 -.35 -.35 ] "point3 p1" [ .35 .35 .35 ]
  "rgb sigma_s" [ 1 2 3  3 2 1  0 1 0  2 2 2  4 0 1  1 1 1  2 3 4  0 0 2 ]
  "rgb sigma_a" [ 0 1 0  1 0 0  0 0 1  0 0 0  1 1 1  0 0 0  1 0 1  2 1 0 ]
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
AttributeBegin
  MediumInterface "" ""
  LightSource "point" "rgb I" [ .4 .6 1.2 ] "point3 from" [ -.6 .5 -1.7 ]
  LightSource "spot" "rgb I" [ 6 5 4 ] "point3 from" [ .8 1.6 -1.8 ] "point3 to" [ -.2 0 .3 ]
    "float coneangle" 35 "float conedeltaangle" 12
AttributeEnd
AttributeBegin
  MediumInterface "milk" "fog"
  Material "dielectric" "float eta" 1.4 "float roughness" .4 "bool remaproughness" false
  Translate -.4 .45 .2
  Shape "sphere" "float radius" .4
AttributeEnd
AttributeBegin
  MediumInterface "smoke" "fog"
  Material "interface"
  Translate .45 .6 -.1
  Shape "sphere" "float radius" .4
AttributeEnd
)"};
}

// A cloud under the sky and a distant light, above a floor; the camera is outside.
inline AgreementScene cloud_scene() {
  return {"cloud", R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1.4 -4  0 .7 0  0 1 0
Camera "perspective" "float fov" 32
)" + chains(".8") + R"(
Integrator "path" "integer maxdepth" 5
WorldBegin
LightSource "infinite" "rgb L" [ .2 .3 .4 ]
LightSource "distant" "rgb L" [ 2.5 2.4 2 ] "point3 from" [ 1 2 -1 ] "point3 to" [ 0 0 0 ]
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .5 .4 .3 ]
  Shape "bilinearmesh" "point3 P" [ -2 0 2  2 0 2  -2 0 -2  2 0 -2 ]
AttributeEnd
AttributeBegin
  Translate -.8 .25 -.8
  Scale 1.6 1.6 1.6
  MakeNamedMedium "cloud" "string type" "cloud" "integer resolution" 24 "float density" 2
    "rgb sigma_s" [ 3 3 3 ] "rgb sigma_a" [ .1 .2 .3 ]
AttributeEnd
AttributeBegin
  MediumInterface "cloud" ""
  Material "interface"
  Translate 0 1 0
  Shape "sphere" "float radius" .75
AttributeEnd
)"};
}

// Everything moves: the camera turns and has a lens, a ball of glass travels, an object tumbles.
inline AgreementScene moving_scene() {
  return {"moving", std::string(R"(
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1 -3.4  0 .9 0  0 1 0
ActiveTransform EndTime
Rotate 6 0 1 0
Translate .1 0 .2
ActiveTransform All
Camera "perspective" "float fov" 40 "float lensradius" .08 "float focaldistance" 3.2
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
LightSource "point" "rgb I" [ .2 .3 .6 ] "point3 from" [ -.6 .5 -.6 ]
AttributeBegin
  ActiveTransform EndTime
  Translate .4 .2 0
  ActiveTransform All
  Translate -.5 .45 .2
  Material "dielectric" "float eta" 1.5
  Shape "sphere" "float radius" .35
AttributeEnd
ObjectBegin "block"
  Material "conductor" "rgb reflectance" [ .8 .7 .5 ] "float roughness" .3
    "bool remaproughness" false
  Shape "trianglemesh"
    "point3 P" [ .4 0 0  -.4 0 0  0 .4 0  0 -.4 0  0 0 .4  0 0 -.4 ]
    "integer indices" [ 0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5 ]
ObjectEnd
AttributeBegin
  Translate .5 .9 .1
  ActiveTransform EndTime
  Rotate 70 1 1 0
  ActiveTransform All
  ObjectInstance "block"
AttributeEnd
)"};
}

}  // namespace pssmlt::test
