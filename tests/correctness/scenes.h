// Small scenes, given as text, on which techniques must agree. Together they have area,
// point, spot, distant and infinite lights, at least three each, textures, rough and smooth glass,
// mirrors, depth of field, cut-outs, instances, shading normals, cameras with and without
// perspective, and crops that are not square. endpoint_agreement_test.cpp has the other lights and
// cameras.
#pragma once

#include <string>
#include <vector>

#include "tests/correctness/scenes_layered.h"
#include "tests/correctness/scenes_media.h"

namespace pssmlt::test {

inline AgreementScene lens_scene() {
  return {"lens", std::string(R"(
Film "rgb" "integer xresolution" 64 "integer yresolution" 40
  "float cropwindow" [ .125 .875 .4 .8 ]
PixelFilter "box"
LookAt 0 1 -3.6  0 1 0  0 1 0
Camera "perspective" "float fov" 36 "float lensradius" .12 "float focaldistance" 3.2
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
LightSource "point" "rgb I" [ .2 .3 .6 ] "point3 from" [ -.6 .5 -.6 ]
LightSource "spot" "rgb I" [ 4 3 2 ] "point3 from" [ .8 1.6 -.8 ] "point3 to" [ -.2 0 .3 ]
  "float coneangle" 35 "float conedeltaangle" 12
AttributeBegin
  Translate -.45 .35 .3
  Material "conductor" "rgb reflectance" [ .8 .7 .5 ] "float roughness" .25
    "bool remaproughness" false
  Shape "sphere" "float radius" .35
AttributeEnd
AttributeBegin
  Translate .45 .3 -.1
  Material "diffuse" "rgb reflectance" [ .3 .5 .7 ]
  AreaLightSource "diffuse" "rgb L" [ .4 .2 .5 ]
  Shape "sphere" "float radius" .3
AttributeEnd
)"};
}

inline AgreementScene glass_scene() {
  return {"glass", R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "triangle" "float xradius" 1.5 "float yradius" 1.5
LookAt 0 3.2 -2.6  0 .2 0  0 1 0
Camera "perspective" "float fov" 38
)" + chains(".8") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
LightSource "infinite" "rgb L" [ .15 .18 .24 ]
LightSource "distant" "rgb L" [ 1.5 1.4 1.2 ] "point3 from" [ 1 2 -1 ] "point3 to" [ 0 0 0 ]
AttributeBegin
  Texture "checks" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 8
    "rgb tex1" [ .8 .8 .8 ] "rgb tex2" [ .2 .3 .2 ]
  Material "diffuse" "texture reflectance" "checks"
  Shape "bilinearmesh" "point3 P" [ -2 0 2  2 0 2  -2 0 -2  2 0 -2 ]
    "point2 uv" [ 0 0  1 0  0 1  1 1 ]
AttributeEnd
AttributeBegin
  Translate -.7 .6 0
  Material "dielectric" "spectrum eta" [ 400 1.8  700 1.4 ]
  Shape "sphere" "float radius" .55
AttributeEnd
AttributeBegin
  Translate .7 .6 .3
  Material "conductor" "rgb reflectance" [ .9 .8 .7 ] "float roughness" 0
  Shape "sphere" "float radius" .55
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Translate -.2 3.2 1.2
  Shape "sphere" "float radius" .6
AttributeEnd
)"};
}

inline AgreementScene rough_scene() {
  return {"rough", R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 48
  "integer pixelbounds" [ 4 28 9 41 ]
PixelFilter "mitchell"
LookAt 0 1.6 -4  0 .6 0  0 1 0
Camera "perspective" "float fov" 34
)" + chains(".8") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
LightSource "infinite" "rgb L" [ .12 .13 .14 ]
LightSource "spot" "rgb I" [ 2 1.8 1.6 ] "point3 from" [ -1.5 2.5 -1 ] "point3 to" [ 0 0 0 ]
  "float coneangle" 40 "float conedeltaangle" 20
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .5 .45 .4 ]
  Shape "disk" "float radius" 2
AttributeEnd
AttributeBegin
  Rotate -90 1 0 0
  Material "diffuse" "rgb reflectance" [ .5 .45 .4 ]
  Shape "disk" "float radius" 2
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 5 5 5 ] "bool twosided" true
  Shape "trianglemesh" "point3 P" [ .4 1.7 .6  1.6 1.5 .2  1.1 2.4 .7 ] "integer indices" [ 0 1 2 ]
AttributeEnd
ObjectBegin "ball"
  Material "dielectric" "float eta" 1.5 "float roughness" .5 "bool remaproughness" false
  Shape "sphere" "float radius" .45
ObjectEnd
AttributeBegin
  Translate -.6 .5 -.2
  ObjectInstance "ball"
AttributeEnd
AttributeBegin
  Translate .55 .5 .4
  Scale 1 .8 1.2
  ObjectInstance "ball"
AttributeEnd
AttributeBegin
  Texture "holes" "float" "checkerboard" "float uscale" 5 "float vscale" 3
    "float tex1" 1 "float tex2" .3
  Material "conductor" "rgb reflectance" [ .8 .6 .4 ] "float uroughness" .15
    "float vroughness" .5 "bool remaproughness" false
  Translate .1 .02 -.9
  Rotate -90 1 0 0
  Shape "cylinder" "float radius" .3 "float zmin" 0 "float zmax" .5 "texture alpha" "holes"
AttributeEnd
)"};
}

inline AgreementScene parallel_scene() {
  return {"parallel", std::string(R"(
Film "rgb" "integer xresolution" 48 "integer yresolution" 40
  "integer pixelbounds" [ 0 48 16 32 ]
PixelFilter "box"
LookAt .3 1.2 -3  0 .9 0  0 1 0
Camera "orthographic" "float screenwindow" [ -1.2 1.2 -1 1 ]
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
LightSource "point" "rgb I" [ .6 .5 .4 ] "point3 from" [ .3 1.5 -.3 ]
LightSource "distant" "rgb L" [ .6 .7 .9 ] "point3 from" [ .3 .6 -2 ] "point3 to" [ 0 0 0 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 2 3 4 ] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [ -.8 .4 .2  -.4 .4 0  -.8 1 .2  -.4 1 .1 ]
AttributeEnd
AttributeBegin
  Translate .35 .4 .2
  MakeNamedMaterial "mirror" "string type" "conductor" "rgb reflectance" [ .9 .9 .9 ]
    "float roughness" 0
  MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [ .5 .2 .2 ]
  Material "mix" "string materials" [ "mirror" "paint" ] "float amount" .6
  Shape "sphere" "float radius" .4
AttributeEnd
AttributeBegin
  Material "thindielectric" "float eta" 1.5
  Shape "bilinearmesh" "point3 P" [ -.2 0 -.8  .8 0 -.6  -.2 .9 -.8  .8 .9 -.6 ]
AttributeEnd
)"};
}

inline AgreementScene normals_scene() {
  return {"normals", std::string(R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "gaussian"
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 36 "float lensradius" .05 "float focaldistance" 3.4
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
LightSource "spot" "rgb I" [ 5 5 5 ] "point3 from" [ -.7 1.7 -.9 ] "point3 to" [ 0 .4 .2 ]
  "float coneangle" 45 "float conedeltaangle" 20
LightSource "infinite" "rgb L" [ .4 .4 .5 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 7 6 5 ]
  Translate .4 1.9 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" .4
AttributeEnd
AttributeBegin  # an octahedron whose normals pretend that it is a ball
  Translate -.4 .55 .1
  Scale .5 .5 .5
  Material "diffuse" "rgb reflectance" [ .7 .7 .7 ]
  Shape "trianglemesh"
    "point3 P" [ 1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1 ]
    "normal N" [ 1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1 ]
    "integer indices" [ 0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5 ]
AttributeEnd
AttributeBegin
  Translate .45 .45 0
  Material "dielectric" "float eta" 1.4 "float roughness" .4 "bool remaproughness" false
  Shape "trianglemesh"
    "point3 P" [ .4 0 0  -.4 0 0  0 .4 0  0 -.4 0  0 0 .4  0 0 -.4 ]
    "normal N" [ 1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1 ]
    "integer indices" [ 0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5 ]
AttributeEnd
)"};
}

inline AgreementScene window_scene() {
  return {"window", std::string(R"(
Film "rgb" "integer xresolution" 72 "integer yresolution" 56
  "integer pixelbounds" [ 19 51 21 37 ]
PixelFilter "sinc" "float xradius" 2 "float yradius" 2
LookAt 0 1 -2.9  .1 1 0  0 1 0
Camera "perspective" "float fov" 45
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 5
WorldBegin
)") + room + R"(
LightSource "infinite" "rgb L" [ .2 .3 .5 ]
LightSource "point" "rgb I" [ .5 .5 .4 ] "point3 from" [ .7 .3 .7 ]
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .8 .8 .8 ]
  AreaLightSource "diffuse" "rgb L" [ 4 3.6 3 ]
  Translate -.5 1.2 .5
  Rotate 30 0 0 1
  Rotate 90 0 1 0
  Shape "cylinder" "float radius" .2 "float zmin" -.4 "float zmax" .4
AttributeEnd
AttributeBegin
  Material "dielectric" "float eta" 1.5
  Translate .2 .5 .1
  Scale .9 .9 .9
  Shape "trianglemesh" "point3 P" [ -.3 -.3 -.3  .3 -.3 -.3  .3 .3 -.3  -.3 .3 -.3
    -.3 -.3 .3  .3 -.3 .3  .3 .3 .3  -.3 .3 .3 ]
    "integer indices" [ 0 3 2  0 2 1  4 5 6  4 6 7  0 1 5  0 5 4  2 3 7  2 7 6  0 4 7  0 7 3
    1 2 6  1 6 5 ]
AttributeEnd
AttributeBegin
  Material "interface"
  Translate -.4 .4 -.3
  Shape "sphere" "float radius" .3
AttributeEnd
)"};
}

// More lights than are drawn by power: a hierarchy, and others beside it; received by surfaces that
// reflect, by ones that transmit, and inside a medium.
inline AgreementScene lamps_scene() {
  std::string lamps;
  for (int i = 0; i < 6; ++i) {
    lamps += "AttributeBegin Translate " + std::to_string(0.3 * i - 0.75) + " " +
             std::to_string(0.3 + 0.28 * (i * 2 % 5)) + " .97 Rotate 180 0 1 0\n" +
             "AreaLightSource \"diffuse\" \"rgb L\" [ " + std::to_string(2 + i) + " 6 " +
             std::to_string(9 - i) + " ]\nShape \"disk\" \"float radius\" .09\nAttributeEnd\n";
  }
  return {"lamps", std::string(R"(
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
PixelFilter "box"
LookAt 0 1 -3.4  0 .9 0  0 1 0
Camera "perspective" "float fov" 40
)" + chains(".5") + R"(
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + lamps + R"(
LightSource "infinite" "rgb L" [ .1 .12 .15 ]
LightSource "distant" "rgb L" [ .3 .3 .2 ] "point3 from" [ .3 .6 -2 ] "point3 to" [ 0 0 0 ]
LightSource "point" "rgb I" [ .2 .3 .6 ] "point3 from" [ -.6 1.5 -.6 ]
LightSource "spot" "rgb I" [ 3 2 2 ] "point3 from" [ .8 1.6 -.8 ] "point3 to" [ -.2 0 .3 ]
  "float coneangle" 35 "float conedeltaangle" 12
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 1 2 1 ] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [ -.9 .5 .2  -.6 .5 .0  -.9 .9 .2  -.6 .9 .1 ]
AttributeEnd
AttributeBegin
  Translate .5 .4 .2
  Material "dielectric" "float eta" 1.4 "float roughness" .4 "bool remaproughness" false
  Shape "sphere" "float radius" .35
AttributeEnd
AttributeBegin
  MakeNamedMedium "milk" "string type" "homogeneous" "rgb sigma_a" [ .2 .1 .05 ]
    "rgb sigma_s" [ 1 2 3 ] "float g" -.2
  MediumInterface "milk" ""
  Material "interface"
  Translate -.25 .4 -.2
  Shape "sphere" "float radius" .35
AttributeEnd
)"};
}

inline std::vector<AgreementScene> agreement_scenes() {
  return {lens_scene(),    glass_scene(),  rough_scene(),   parallel_scene(),
          normals_scene(), window_scene(), layered_scene(), fog_scene(),
          cloud_scene(),   moving_scene(), lamps_scene(),   diffusing_scene()};
}

}  // namespace pssmlt::test
