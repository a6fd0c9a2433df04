// A walk over the registry: whatever is there keeps the laws of its kind, as it comes with its
// defaults and, where it has a roughness, rough. A new plugin is tested without a line here.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

std::vector<std::string> names(const std::string& kind) { return Registry::instance().names(kind); }
const auto by_name = [](const auto& test) { return test.param; };

// The material with its defaults, rough if it can be; materials that combine others get some.
std::shared_ptr<const Material> default_material(const std::string& name) {
  static Resolver resolver;
  if (resolver.materials.empty()) {
    resolver.materials = {{"a", make_material("diffuse")}, {"b", make_material("diffuse")}};
  }
  ParameterSet set;
  if (has_parameter("material", name, "roughness")) {
    set = {number("roughness", .6f), flag("remaproughness", false)};
  }
  if (has_parameter("material", name, "materials")) {
    set.push_back(strings(ParameterType::String, "materials", {"a", "b"}));
  }
  return make_material(name, set, &resolver);
}

class AnyMaterial : public testing::TestWithParam<std::string> {
 protected:
  AnyMaterial() : material_(default_material(GetParam())) {
    bsdf_ = material_->bsdf(Hit(), {0.3f, 0.6f}, storage_);
  }
  std::optional<BsdfSample> draw(RandomStream& random, const vec3& wo, Transport mode) const {
    const float lobe = random.next();
    const vec2 u = draw2(random);
    return bsdf_->sample(wo, lobe, u, mode);
  }
  static std::vector<vec3> views() {
    return {{0.f, 0.f, 1.f}, {.6f, 0.f, .8f}, {0.f, -.8f, .6f}, {.48f, .6f, -.64f}};
  }
  std::shared_ptr<const Material> material_;
  BsdfStorage storage_;
  const Bsdf* bsdf_ = nullptr;  // null: invisible, nothing to test
};

// Failures and delta lobes make a bin of their own; the integral of pdf() and their share are one.
TEST_P(AnyMaterial, DirectionsFollowTheirDensity) {
  if (!bsdf_) return;
  for (const vec3& wo : views()) {
    const auto result = chi_square_sphere(
        [&](RandomStream& random) -> std::optional<vec3> {
          const auto s = draw(random, wo, Transport::radiance);
          return s && !s->delta ? std::optional(s->wi) : std::nullopt;
        },
        [&](const vec3& wi) { return static_cast<double>(bsdf_->pdf(wo, wi)); }, {.fine = 64});
    EXPECT_GT(result.p, false_alarm) << wo.z;
    EXPECT_NEAR(result.integral + result.failures, 1.0, 6e-3) << wo.z;
  }
}

TEST_P(AnyMaterial, IsReciprocal) {
  if (!bsdf_) return;
  RandomStream random(5, RandomUse::test);
  for (int i = 0; i < 5000; ++i) {
    const vec3 wo = uniform_sphere(draw2(random));
    const vec3 wi = uniform_sphere(draw2(random));
    const Rgb forward = bsdf_->eval(wo, wi, Transport::radiance);
    const Rgb back = bsdf_->eval(wi, wo, Transport::importance);
    for (int c = 0; c < 3; ++c) {
      ASSERT_GE(forward[c], 0.f);
      ASSERT_NEAR(forward[c], back[c], 2e-3f * forward[c] + 1e-6f);
    }
    ASSERT_TRUE(bsdf_->connectible() || is_black(forward));
    ASSERT_TRUE(material_->traits().transmits || wo.z * wi.z > 0.f || is_black(forward));
  }
}

// Importance is not scaled at boundaries: what leaves is at most what came.
TEST_P(AnyMaterial, GainsNoEnergy) {
  if (!bsdf_) return;
  constexpr int samples = 20000;
  RandomStream random(6, RandomUse::test);
  for (const vec3& wo : views()) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < samples; ++i) {
      const auto s = draw(random, wo, Transport::importance);
      const double w = s ? static_cast<double>(max_component(s->weight)) : 0.0;
      sum += w;
      squares += w * w;
    }
    const double mean = sum / samples;
    const double error = std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
    EXPECT_LE(mean, 1.0 + z_limit * error + 1e-4) << wo.z;
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyMaterial, testing::ValuesIn(names("material")), by_name);

class AnyLight : public testing::TestWithParam<std::string> {
 protected:
  AnyLight() : light_(make_light("LightSource \"" + GetParam() + "\"")) {
    light_->prepare({vec3(0.f), 4.f});
  }
  std::shared_ptr<Light> light_;
};

// What a ray that is emitted and one that is drawn toward a point say is what evaluate() says.
TEST_P(AnyLight, SamplesAgreeWithEvaluate) {
  RandomStream random(7, RandomUse::test);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const vec2 u = draw2(random);
    const vec3 reference = uniform_sphere(draw2(random));
    if (const auto e = light_->emit(u, dvec2(draw2(random)))) {
      const EmissionValue v = light_->evaluate(e->from, e->direction);
      EXPECT_NEAR(v.pdf_direction / e->pdf_direction, 1.f, 2e-3f);
      EXPECT_NEAR(v.pdf_position / e->pdf_position, 1.f, 2e-3f);
      EXPECT_NEAR(luminance(v.value), luminance(e->value), 2e-3f * luminance(e->value));
    }
    const auto t = light_->toward(reference, u);
    if (!t) continue;
    ++found;
    EXPECT_NEAR(light_->pdf_toward(reference, t->at) / t->pdf_toward, 1.f, 5e-3f);
    const EmissionValue v = light_->evaluate(t->at, -t->wi);
    EXPECT_NEAR(v.pdf_direction / t->pdf_direction, 1.f, 2e-3f);
    EXPECT_NEAR(luminance(v.value), luminance(t->value), 2e-3f * luminance(t->value));
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(light_->power(), 0.f);
}

TEST_P(AnyLight, DirectionsFollowTheirDensity) {
  if (light_->traits().delta_direction) return;
  const ChiSquareOptions options{.bins_x = 48, .bins_y = 48, .samples = 100'000, .fine = 24};
  EndpointPoint at;
  const auto result = chi_square_sphere(
      [&](RandomStream& random) -> std::optional<vec3> {
        const vec2 u = draw2(random);
        const auto e = light_->emit(u, dvec2(draw2(random)));
        return e ? std::optional(e->direction) : std::nullopt;
      },
      [&](const vec3& d) {
        at.normal = light_->traits().infinite ? d : vec3(0.f);
        return static_cast<double>(light_->evaluate(at, d).pdf_direction);
      },
      options);
  EXPECT_GT(result.p, false_alarm);
  EXPECT_NEAR(result.integral + result.failures, 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(All, AnyLight, testing::ValuesIn(names("light")), by_name);

class AnyCamera : public testing::TestWithParam<std::string> {};

// A ray through a raster position comes back to it; the picture measures one, so that the density
// of rays is importance.
TEST_P(AnyCamera, ConnectionsReturnToTheRaster) {
  const RasterFrame frame{{64, 48}, {8, 4}, {56, 44}, {0.f, 0.f}};
  const auto camera = make_camera("Camera \"" + GetParam() + "\"", frame);
  RandomStream random(8, RandomUse::test);
  for (int i = 0; i < 2000; ++i) {
    const vec2 lens = draw2(random);
    const dvec2 raster = dvec2(frame.crop_min) + dvec2(draw2(random)) * dvec2(frame.crop_size());
    const auto e = camera->emit(lens, raster);
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->weight().x, 1.f, 1e-3f);
    const vec3 point = e->from.position + 3.f * e->direction;
    const auto t = camera->toward(point, lens);
    ASSERT_TRUE(t) << raster.x << " " << raster.y;
    EXPECT_NEAR(t->raster.x, raster.x, 1e-2);
    EXPECT_NEAR(t->raster.y, raster.y, 1e-2);
    EXPECT_NEAR(t->pdf_direction / e->pdf_direction, 1.f, 2e-3f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyCamera, testing::ValuesIn(names("camera")), by_name);

class AnyFilter : public testing::TestWithParam<std::string> {};

// Camera rays draw their offset from |f|, light splats are spread by f: a constant picture stays
// constant under both, whatever the filter's sign, to the edge of the crop.
TEST_P(AnyFilter, KeepsAConstantPicture) {
  const std::string scene =
      "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 8 "
      "\"integer pixelbounds\" [ 3 8 2 8 ]\nPixelFilter \"" +
      GetParam() + R"("
LookAt 0 0 5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -1.5 1.5 -1 1 ]
Integrator "path" "integer maxdepth" 0
WorldBegin
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "disk" "float radius" 2.2)";
  for (const char* integrator : {"path", "light"}) {
    constexpr int renders = 16;
    const Job job{.scene = scene, .integrator = integrator, .sampler = "independent", .spp = 1024};
    const BlockValues pixels = render_blocks(job, renders, 1);
    // Sixty comparisons at 1e-9.
    const double limit = student_limit(1e-9, renders - 1);
    for (const auto& pixel : pixels) {
      const Estimate e = estimate(pixel);
      EXPECT_NEAR(e.mean, 1.0, limit * e.error() + 1e-4) << integrator;
      EXPECT_LT(e.error(), .06) << integrator;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyFilter, testing::ValuesIn(names("filter")), by_name);

}  // namespace
}  // namespace pssmlt::test
