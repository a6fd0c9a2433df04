// What scenes may say of subsurface scattering; what it looks like is measured with the long tests.
#include <gtest/gtest.h>

#include "core/medium.h"
#include "tests/support/make_plugin.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

using namespace test;

TEST(Subsurface, FourWaysToSayWhatIsInside) {
  const auto inside = [](const ParameterSet& set) {
    return make_material("subsurface", set)->interior()->at(vec3(0.f));
  };
  const auto three = [](const char* name, float v) { return rgb(name, v, v, v); };
  const MediumPoint skin = inside({});
  EXPECT_FLOAT_EQ(skin.scattering.x, 2.55f);
  EXPECT_FLOAT_EQ(skin.extinction.z, 3.77f + .014f);
  const MediumPoint direct = inside({three("sigma_a", 1), three("sigma_s", 3), number("scale", 2)});
  EXPECT_FLOAT_EQ(direct.scattering.y, 6.f);
  EXPECT_FLOAT_EQ(direct.extinction.y, 8.f);
  const MediumPoint named = inside({strings(ParameterType::String, "name", {"Ketchup"})});
  EXPECT_FLOAT_EQ(named.scattering.x, .18f);
  const MediumPoint asked = inside({three("reflectance", .5f), three("mfp", .25f)});
  EXPECT_NEAR(asked.extinction.x, 4.f, 1e-5f);
  EXPECT_GT(asked.scattering.x, 3.f);
}

TEST(Subsurface, RefusesContradictions) {
  const auto error = [](const ParameterSet& set) {
    return error_of([&] { make_material("subsurface", set); });
  };
  const Parameter half = rgb("reflectance", .5f, .5f, .5f);
  EXPECT_NE(error({half, rgb("sigma_a", 1, 1, 1)}).find("only one"), std::string::npos);
  EXPECT_NE(error({rgb("mfp", 1, 1, 1)}).find("reflectance"), std::string::npos);
  EXPECT_NE(error({half, rgb("mfp", 1, 0, 1)}).find("mfp"), std::string::npos);
  EXPECT_NE(error({strings(ParameterType::String, "name", {"Skin3"})}).find("Skin"),
            std::string::npos);
  EXPECT_NE(error({number("g", 1.f)}).find("\"g\""), std::string::npos);
  EXPECT_NE(error_of([] {
              build_text({.scene = R"(WorldBegin
MakeNamedMedium "fog" "string type" "homogeneous"
MediumInterface "fog" ""
Material "subsurface" Shape "sphere")"});
            }).find("brings the medium"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
