// A walk over the registry: whatever is there keeps the laws of its kind, as it comes with its
// defaults and, where it has a roughness, rough. A new plugin is tested without a line here.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/warp.h"
#include "core/fibre.h"
#include "core/image/image.h"
#include "tests/support/chi_square.h"
#include "tests/support/hits.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/measured_files.h"
#include "tests/support/render_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/walk_source.h"

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
  if (has_parameter("material", name, "filename")) {
    static const std::string table = own_file("registry-measured");
    write_bytes(table, merl_file([](const vec3&, const vec3&) { return Rgb(.25f); }));
    set.push_back(text("filename", table));
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

// Importance is not scaled at boundaries: what leaves is at most what came. A fibre scatters light
// by its width, which is the same from everywhere, not by the area of the band that stands for it:
// what is bounded there, for every direction alone, is the sum over the directions that light comes
// from; for importance only the mean over the band's turns is.
TEST_P(AnyMaterial, GainsNoEnergy) {
  if (!bsdf_) return;
  const bool fibre = is_of_fibres(*material_);
  const Transport mode = fibre ? Transport::radiance : Transport::importance;
  constexpr int samples = 20000;
  RandomStream random(6, RandomUse::test);
  WalkSource walks(6);
  for (const vec3& wo : views()) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < samples; ++i) {
      // What a material draws at a hit is part of the mean.
      bsdf_ = material_->bsdf(Hit(), walks.next(), storage_);
      const auto s = draw(random, wo, mode);
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

// A square image of random pixels, one of them bright, for plugins that show one.
std::string image_file() {
  static const std::string path = [] {
    Image image(4, 4, 3);
    RandomStream random(11, RandomUse::test);
    for (float& v : image.data) v = 0.2f + random.next();
    for (int c = 0; c < 3; ++c) image.pixel(2, 1)[c] *= 10.f;
    const std::string file = test::own_file("registry-image.pfm");
    write_image(file, image, {}, {});
    return file;
  }();
  return path;
}

// Every light as it comes and, if it can show an image, with one; some need it.
struct LightCase {
  std::string name, text;
};
void PrintTo(const LightCase& c, std::ostream* out) { *out << c.name; }

std::vector<LightCase> light_cases() {
  std::vector<LightCase> all;
  for (const std::string& name : names("light")) {
    const std::string text = "LightSource \"" + name + "\"";
    const bool shows_images = has_parameter("light", name, "filename");
    const std::string image = " \"string filename\" \"" + image_file() + "\"";
    if (shows_images) all.push_back({name + "_image", "Rotate 40 1 2 3 " + text + image});
    if (!shows_images || error_of([&] { make_light(text); }).empty()) all.push_back({name, text});
  }
  return all;
}

class AnyLight : public testing::TestWithParam<LightCase> {
 protected:
  AnyLight() : light_(make_light(GetParam().text)) { light_->prepare({vec3(0.f), 4.f}); }
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

// What the choice among many lights goes by: rays start in the box and leave within the cones, and
// the intensity is that of the power.
TEST_P(AnyLight, StaysInItsBounds) {
  const auto bounds = light_->bounds();
  EXPECT_NE(bounds.has_value(), light_->traits().infinite);
  if (!bounds) return;
  const DirectionCone& cone = bounds->normals;
  const float reach = std::acos(std::clamp(cone.cosine, -1.f, 1.f)) + std::acos(bounds->cos_spread);
  RandomStream random(8, RandomUse::test);
  for (int i = 0; i < 2000; ++i) {
    const vec2 u = draw2(random);
    const auto e = light_->emit(u, dvec2(draw2(random)));
    if (!e) continue;
    EXPECT_EQ(glm::clamp(e->from.position, bounds->box.min, bounds->box.max), e->from.position);
    EXPECT_LE(std::acos(std::clamp(glm::dot(e->direction, cone.axis), -1.f, 1.f)), reach + 1e-3f);
  }
  EXPECT_GE(bounds->intensity, light_->power() / (4.f * pi) * (1.f - 1e-5f));
}

// Emitted rays carry the power that the light says. Five sigma of the mean, and rounding.
TEST_P(AnyLight, RaysCarryThePower) {
  RandomStream random(12, RandomUse::test);
  constexpr int rays = 50'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < rays; ++i) {
    const vec2 u = draw2(random);
    const auto e = light_->emit(u, dvec2(draw2(random)));
    const double w = e ? static_cast<double>(luminance(e->weight())) : 0.0;
    sum += w;
    squares += w * w;
  }
  const double mean = sum / rays;
  const double error = std::sqrt(std::max(0.0, squares / rays - mean * mean) / rays);
  EXPECT_NEAR(mean, light_->power(), 5.0 * error + 2e-3 * mean);
}

TEST_P(AnyLight, DirectionsFollowTheirDensity) {
  if (light_->traits().delta_direction) return;
  const ChiSquareOptions options{.bins_x = 48, .bins_y = 48, .samples = 100'000, .fine = 48};
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

INSTANTIATE_TEST_SUITE_P(All, AnyLight, testing::ValuesIn(light_cases()),
                         [](const auto& test) { return test.param.name; });

// The camera with its defaults; one that needs a lens system gets a single lens.
std::shared_ptr<Camera> default_camera(const std::string& name, const RasterFrame& frame) {
  std::string text = "Camera \"" + name + "\"";
  if (has_parameter("camera", name, "lensfile")) {
    const std::string file = own_file("registry-lens.dat");
    std::ofstream(file) << "60 8 1.6 30\n-90 3 1 30\n0 60 0 30\n";
    text += " \"string lensfile\" \"" + file + "\"";
  }
  return make_camera(text, frame);
}

class AnyCamera : public testing::TestWithParam<std::string> {};

// A ray through a raster position comes back to it with its densities; of cameras that measure
// radiance the picture measures one, so that the density of rays is importance.
TEST_P(AnyCamera, ConnectionsReturnToTheRaster) {
  const RasterFrame frame{{64, 48}, {8, 4}, {56, 44}, {0.f, 0.f}};
  const auto camera = default_camera(GetParam(), frame);
  const bool one_way = camera->traits().delta_position || camera->traits().delta_direction;
  RandomStream random(8, RandomUse::test);
  int emitted = 0;
  for (int i = 0; i < 2000; ++i) {
    const vec2 lens = draw2(random);
    const dvec2 raster = dvec2(frame.crop_min) + dvec2(draw2(random)) * dvec2(frame.crop_size());
    const auto e = camera->emit(lens, raster);
    if (!e) continue;
    ++emitted;
    if (!camera->measures_irradiance()) {
      EXPECT_NEAR(e->weight().x, 1.f, 1e-3f);
    }
    EXPECT_GT(e->weight().x, 0.f);
    const EmissionValue v = camera->evaluate(e->from, e->direction);
    EXPECT_NEAR(v.pdf_position * v.pdf_direction / (e->pdf_position * e->pdf_direction), 1.f,
                2e-3f);
    const vec3 point = e->from.position + 3.f * e->direction;
    EXPECT_GT(camera->pdf_toward(point, e->from), 0.f);
    if (camera->bare() && camera->traits().delta_position) continue;  // all over the picture
    const auto back = camera->raster(e->from.position, e->direction);
    ASSERT_TRUE(back) << raster.x << " " << raster.y;
    EXPECT_LT(glm::distance(*back, raster), 1.5e-2);
    if (!one_way) continue;
    const auto t = camera->toward(point, lens);
    ASSERT_TRUE(t) << raster.x << " " << raster.y;
    EXPECT_LT(glm::distance(t->raster, raster), 1.5e-2);
    EXPECT_NEAR(t->pdf_direction / e->pdf_direction, 1.f, 2e-3f);
  }
  // Some rays do not get through a lens system.
  EXPECT_GE(emitted, camera->measures_irradiance() ? 1000 : 2000);
}

INSTANTIATE_TEST_SUITE_P(All, AnyCamera, testing::ValuesIn(names("camera")), by_name);

class AnyTexture : public testing::TestWithParam<std::string> {};

// Values are valid near and far, and the same however a point was found: its place and how wide a
// pixel is there decide, the ray that met it does not.
template <typename T>
void expect_function_of_the_point(const std::string& name) {
  const auto texture = make_texture<T>(name);
  RandomStream random(10, RandomUse::test);
  for (int i = 0; i < 2000; ++i) {
    const float size = std::exp2(static_cast<float>(i % 30));
    Hit hit = at_point(size * uniform_sphere(draw2(random)));
    hit.uv = size * (2.f * draw2(random) - 1.f);
    hit.ng = hit.ns = uniform_sphere(draw2(random));
    hit.footprint = i % 3 == 0 ? 0.f : std::exp2(-static_cast<float>(i % 17));
    const Rgb value(texture->evaluate(hit));
    ASSERT_TRUE(is_finite(value)) << i;
    hit.distance = 3.f * size;
    hit.error = vec3(1e-3f);
    ASSERT_EQ(Rgb(texture->evaluate(hit)), value) << i;
    if (texture->constant()) {
      ASSERT_EQ(Rgb(texture->evaluate(Hit())), value);
    }
  }
}

TEST_P(AnyTexture, IsAFunctionOfThePoint) {
  if (has_parameter("texture", GetParam(), "filename")) return;  // nothing to show without one
  const PluginDescriptor& d = *Registry::instance().find("texture", GetParam(), {}).descriptor;
  ASSERT_TRUE(d.create || d.create_rgb);
  if (d.create) expect_function_of_the_point<float>(GetParam());
  if (d.create_rgb) expect_function_of_the_point<Rgb>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, AnyTexture, testing::ValuesIn(names("texture")), by_name);

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
