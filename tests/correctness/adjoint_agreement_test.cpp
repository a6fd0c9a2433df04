// Rays from the camera and rays from the lights agree on what does not scatter alike both ways, by
// blocks of pixels: hair, on curves of each type, close enough to light one another, between a lamp
// in front and one behind; and tables of measurements that are not symmetric.
//
// False alarms: below 10^-6 a test. Power: 0.99 against an error of 4 % that all blocks have, and
// of 30 % in one block alone, computed from the errors measured and asserted.
#include <gtest/gtest.h>

#include "tests/correctness/classes.h"
#include "tests/correctness/scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/measured_files.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt::test {
namespace {

constexpr int edge = 8;      // of a block [pixels]
constexpr int renders = 24;  // of each technique, at least
constexpr Demand demand{4e-7, .3, .04};
constexpr Precision reference_goal{.016, .002};

// A row of curves from the floor, bent and turned; widths from a third to a fifteenth of a metre.
std::string hair_room() {
  std::string text = std::string(R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
PixelFilter "triangle" "float xradius" 1.5 "float yradius" 1.5
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 34
Sampler "pssmlt" "integer bootstrapsamples" 8192 "integer chains" 64
  "float largestepprobability" .5
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.4 1.98 -.4  .4 1.98 -.4  -.4 1.98 .4  .4 1.98 .4 ]
AttributeEnd
LightSource "point" "rgb I" [ .8 .9 1 ] "point3 from" [ .1 .8 .8 ]
)";
  const char* const kinds[] = {R"("string type" "flat" )", R"("string type" "cylinder" )",
                               R"("string type" "ribbon" "normal N" [ .3 0 -1  1 .2 -1 ] )"};
  const char* const colours[] = {R"("rgb sigma_a" [ .05 .1 .2 ] )",
                                 R"("float eumelanin" .3 "float beta_m" .5 "float beta_n" .6 )",
                                 R"("rgb reflectance" [ .8 .5 .3 ] "float alpha" 4 )"};
  for (int i = 0; i < 9; ++i) {
    const double x = -.8 + .2 * i;
    text += fmt::format(
        "Material \"hair\" {}\nShape \"curve\" {} \"float width0\" .3 \"float width1\" .07\n"
        "  \"point3 P\" [ {} 0 {}  {} .7 .1  {} 1 -.4  {} 1.5 {} ]\n",
        colours[i % 3], kinds[i / 3], x, .3 - .1 * (i % 4), x + .1, x - .1, x + .05,
        .2 * (i % 3) - .1);
  }
  return text;
}

// Balls of tables: one that reflects up to three times more of what comes from the side than what
// it sends there, and is not alike in all azimuths; one of the other format, symmetric.
std::string table_room() {
  const auto lopsided = [](const vec3& wo, const vec3& wi) {
    return Rgb(.6f, .5f, .3f) * ((.3f + .9f * sqr(wi.x)) * (.4f + .6f * wo.z) * inv_pi);
  };
  const auto plain = [](const vec3& wo, const vec3& wi) {
    return Rgb(.3f, .4f, .6f) * ((.4f + std::pow(glm::normalize(wo + wi).z, 30.f)) * inv_pi);
  };
  RglOptions options{.normals = Ggx(1.f, 1.f), .size = 16};
  for (int i = 0; i <= 8; ++i) options.phi.push_back(pi * (static_cast<float>(i) / 4.f - 1.f));
  options.phi.erase(options.phi.begin());
  const std::string tensors = own_file("lopsided"), merl = own_file("plain");
  write_bytes(tensors, tensor_file(lopsided, options).bytes());
  write_bytes(merl, merl_file(plain));
  return std::string(R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
PixelFilter "triangle" "float xradius" 1.5 "float yradius" 1.5
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 34
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room +
         fmt::format(R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.4 1.98 -.4  .4 1.98 -.4  -.4 1.98 .4  .4 1.98 .4 ]
AttributeEnd
Material "measured" "string filename" "{}"
AttributeBegin
  Translate -.45 .55 0
  Shape "sphere" "float radius" .5
AttributeEnd
AttributeBegin
  Translate .5 .55 0
  Material "measured" "string filename" "{}"
  Shape "sphere" "float radius" .45
AttributeEnd
)",
                     tensors, merl);
}

TEST(TableAgreement, AcrossTechniques) {
  Job job{.scene = table_room(), .sampler = "independent"};
  for (const char* other : {"bdpt", "light"}) {
    job.set = {"integrator.paths=" + both(sees("path"), sees(other))};
    job.integrator = "path";
    const Blocks truth = render_to_precision(job, renders, edge, reference_goal, 2048);
    job.integrator = other;
    expect_agreement(
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 4096), truth,
        demand, other);
  }
}

TEST(HairAgreement, AcrossTechniques) {
  Job job{.scene = hair_room(), .sampler = "independent"};
  for (const char* other : {"bdpt", "light"}) {
    job.set = {"integrator.paths=" + both(sees("path"), sees(other))};
    job.integrator = "path";
    job.sampler = "independent";
    const Blocks truth = render_to_precision(job, renders, edge, reference_goal, 2048);
    job.integrator = other;
    expect_agreement(
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 4096), truth,
        demand, other);
    job.sampler = "pssmlt";
    expect_agreement(
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 4096), truth,
        demand, std::string(other) + " under pssmlt");
  }
}

}  // namespace
}  // namespace pssmlt::test
