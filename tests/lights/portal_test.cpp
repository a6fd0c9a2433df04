// Portals: windows are sampled exactly, and infinite lights with one draw directions as they say,
// from inside and outside, without losing any.
#include "core/portal.h"

#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "core/image/image.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

WindowDistribution noise_grid(int size) {
  RandomStream random(3, RandomUse::test);
  std::vector<float> values;
  // A third of the cells is black.
  for (int i = 0; i < size * size; ++i) {
    const float value = 0.1f + random.next();
    values.push_back((i % size + i / size) % 3 == 1 ? 0.f : value);
  }
  return {values, size};
}

const std::vector<WindowDistribution::Window>& windows() {
  static const std::vector<WindowDistribution::Window> all = {{{0.0, 0.0}, {1.0, 1.0}},
                                                              {{0.21, 0.37}, {0.68, 0.92}},
                                                              {{0.5, 0.125}, {0.52, 0.875}},
                                                              {{0.61, 0.33}, {0.62, 0.34}}};
  return all;
}

// By the midpoint rule, on a grid that resolves the cells.
TEST(WindowDistribution, IntegralsAreExact) {
  const WindowDistribution grid = noise_grid(8);
  for (const auto& w : windows()) {
    constexpr int n = 2000;
    double sum = 0.0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        sum += grid.value(w.low + (w.high - w.low) * dvec2((i + 0.5) / n, (j + 0.5) / n));
    const double area = (w.high.x - w.low.x) * (w.high.y - w.low.y);
    EXPECT_NEAR(grid.integral(w), sum / n / n * area, 2e-3 * grid.integral(w));
  }
}

// Shares of 4 x 4 parts of the window against their integrals. 64 comparisons at six sigma: false
// alarms below 1e-6; an error of 2 % of a part's share is 3 sigma and grows with the samples.
TEST(WindowDistribution, SamplesFollowTheIntegral) {
  const WindowDistribution grid = noise_grid(8);
  RandomStream random(4, RandomUse::test);
  for (const auto& w : windows()) {
    constexpr int samples = 400'000, parts = 4;
    std::array<int, parts * parts> counts{};
    for (int i = 0; i < samples; ++i) {
      const dvec2 p = grid.sample(dvec2(draw2(random)), w);
      ASSERT_TRUE(w.contains(p));
      ASSERT_GT(grid.value(p), 0.0);
      const dvec2 part = (p - w.low) / (w.high - w.low) * static_cast<double>(parts);
      const int x = std::min(static_cast<int>(part.x), parts - 1);
      const int y = std::min(static_cast<int>(part.y), parts - 1);
      ++counts[static_cast<size_t>(y * parts + x)];
    }
    for (int k = 0; k < parts * parts; ++k) {
      const dvec2 size = (w.high - w.low) / static_cast<double>(parts);
      const dvec2 low = w.low + size * dvec2(k % parts, k / parts);
      const double share = grid.integral({low, low + size}) / grid.integral(w);
      const double error = std::sqrt(samples * share * (1.0 - share));
      EXPECT_NEAR(counts[static_cast<size_t>(k)], samples * share, 6.0 * error + 1.0) << k;
    }
  }
}

// A window in the ceiling at y = 1.
constexpr const char* ceiling = "\"point3 portal\" [-.6 1 -.4  .6 1 -.4  .6 1 .4  -.6 1 .4] ";

std::vector<std::string> lights() {
  Image image(16, 16, 3);
  RandomStream random(5, RandomUse::test);
  for (float& v : image.data) v = 0.1f + random.next();
  const std::string file = test::own_file("portal.pfm");
  write_image(file, image, {}, {});
  return {"LightSource \"infinite\" ",
          "Rotate 30 1 2 3 LightSource \"infinite\" "
          "\"string filename\" \"" +
              file + "\" "};
}

// From inside, below the sill of the window's plane, far off to its side, and from outside.
const std::vector<vec3>& places() {
  static const std::vector<vec3> all = {
      {0.1f, 0.f, -0.2f}, {-0.5f, 0.9f, 0.3f}, {1.5f, 0.2f, 0.4f}, {0.2f, 1.5f, 0.f}};
  return all;
}

TEST(Portal, DirectionsFollowTheirDensity) {
  for (const std::string& text : lights()) {
    const auto light = make_light(text + ceiling);
    light->prepare({vec3(0.f), 2.f});
    for (const vec3& from : places()) {
      EndpointPoint at;
      const ChiSquareOptions options{.bins_x = 24, .bins_y = 24, .samples = 100'000, .fine = 96};
      const auto result = chi_square_sphere(
          [&](RandomStream& random) -> std::optional<vec3> {
            const auto t = light->toward(from, draw2(random));
            return t ? std::optional(t->wi) : std::nullopt;
          },
          [&](const vec3& d) {
            at.normal = -d;
            return static_cast<double>(light->pdf_toward(from, at));
          },
          options);
      ASSERT_GT(result.p, false_alarm) << from.x;
      // Windows have sharp edges.
      EXPECT_NEAR(result.integral + result.failures, 1.0, 1e-2) << from.x;
    }
  }
}

// Seven of eight directions lead through the window, most of the rest do not; what is seen is the
// same as without.
TEST(Portal, GuidesWhatIsDrawn) {
  for (const std::string& text : lights()) {
    const auto light = make_light(text + ceiling), free = make_light(text);
    RandomStream random(6, RandomUse::test);
    int through = 0, drawn = 0;
    double sum = 0.0, squares = 0.0, free_sum = 0.0, free_squares = 0.0;
    const vec3 from = places()[0];
    constexpr int samples = 20'000;
    for (int i = 0; i < samples; ++i) {
      const auto t = light->toward(from, draw2(random));
      if (!t) continue;
      ++drawn;
      const vec3 p = from + t->wi * ((1.f - from.y) / t->wi.y);
      const bool inside = t->wi.y > 0.f && std::abs(p.x) <= 0.6f && std::abs(p.z) <= 0.4f;
      through += inside;
      EXPECT_EQ(t->value, free->background(t->wi));
      const double y = inside ? static_cast<double>(luminance(t->value) / t->pdf_toward) : 0.0;
      sum += y;
      squares += y * y;
      const auto f = free->toward(from, draw2(random));
      if (!f) continue;
      const vec3 q = from + f->wi * ((1.f - from.y) / f->wi.y);
      const bool hits = f->wi.y > 0.f && std::abs(q.x) <= 0.6f && std::abs(q.z) <= 0.4f;
      const double z = hits ? static_cast<double>(luminance(f->value) / f->pdf_toward) : 0.0;
      free_sum += z;
      free_squares += z * z;
    }
    EXPECT_GT(through, 0.87 * drawn);
    const auto variance = [](double s, double s2) { return (s2 / samples - sqr(s / samples)); };
    const double guided = variance(sum, squares), unguided = variance(free_sum, free_squares);
    EXPECT_LT(guided, 0.1 * unguided);
    EXPECT_NEAR(sum / samples, free_sum / samples, 5.0 * std::sqrt((guided + unguided) / samples));
  }
}

// The corners are given in world space: the light's own rotation turns the map alone.
TEST(Portal, StaysInWorldSpace) {
  const auto turned = make_light(std::string("Rotate 90 0 0 1 ") + lights()[0] + ceiling);
  const auto plain = make_light(lights()[0] + ceiling);
  EndpointPoint at;
  at.normal = {0.f, -1.f, 0.f};
  EXPECT_EQ(turned->pdf_toward(places()[0], at), plain->pdf_toward(places()[0], at));
  EXPECT_GT(plain->pdf_toward(places()[0], at), 1.f / (4.f * pi));
}

TEST(Portal, WrongOnesAreErrors) {
  const auto message = [](const std::string& points) {
    return error_of(
        [&] { make_light("LightSource \"infinite\" \"point3 portal\" [ " + points + " ]"); });
  };
  EXPECT_NE(message("0 0 0").find("four points"), std::string::npos);
  EXPECT_NE(message("0 0 0  1 0 0  1 1 0  0.2 1 0").find("no rectangle"), std::string::npos);
  EXPECT_NE(message("0 0 0  1 0 0  1.3 1 0  0.3 1 0").find("no rectangle"), std::string::npos);
  EXPECT_NE(message("0 0 0  0 0 0  1 1 0  1 1 0").find("no rectangle"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
