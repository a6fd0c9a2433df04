// The recursive weights against their definition: every strategy's density of a whole path, vertex
// by vertex, as Veach 1997, section 10.2, writes it.
#include "core/path/mis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace pssmlt {
namespace {

enum class LightKind { area, point, infinite, distant };

// A path of n vertices, 0 on the light, n - 1 on the lens, with made-up densities.
struct RandomPath {
  RandomPath(RandomStream& u, LightKind light_kind) : kind(light_kind) {
    n = 2 + static_cast<int>(u.next() * 8.f);
    for (int i = 0; i < n; ++i) {
      // From 10^-2 to 10^2, so that ratios spread widely.
      const auto any = [&u] { return std::pow(10.0, 4.0 * static_cast<double>(u.next()) - 2.0); };
      toward_camera.push_back(any());
      toward_light.push_back(any());
      cos_camera.push_back(0.01 + 0.99 * static_cast<double>(u.next()));
      cos_light.push_back(0.01 + 0.99 * static_cast<double>(u.next()));
      distance2.push_back(any());
      delta.push_back(i > 0 && i + 1 < n && u.next() < 0.3f);
      pass.push_back(u.next() < 0.5f ? 1.0 : 0.05 + 0.95 * static_cast<double>(u.next()));
    }
    probability = 0.1 + 0.9 * static_cast<double>(u.next());
    light_position = toward_camera[0] * 0.7;
    lens_position = toward_light[0] * 0.3;
    light_drawn = toward_camera[0] * 2.0;
    lens_drawn = toward_light[0] * 3.0;
    if (light_kind != LightKind::area) cos_camera[0] = 1.0;
    if (infinite()) distance2[0] = 1.0;
  }
  bool infinite() const { return kind == LightKind::infinite || kind == LightKind::distant; }
  bool hittable() const { return kind == LightKind::area || kind == LightKind::infinite; }

  LightKind kind;
  int n = 0;
  double probability = 1.0;
  // Densities of the direction taken at a vertex, per solid angle, walking either way; at the ends
  // those of emission. toward_camera[i]: from i to i + 1.
  std::vector<double> toward_camera, toward_light;
  std::vector<double> cos_camera, cos_light;  // at vertex i, of the edges to i + 1 and to i - 1
  std::vector<double> distance2;              // of the edge from i to i + 1
  std::vector<double> pass;                   // probability that a walk gets along it through media
  std::vector<bool> delta;
  double light_position = 1.0, lens_position = 1.0;  // of emission
  double light_drawn = 1.0, lens_drawn = 1.0;        // of drawing the endpoint, per solid angle
};

bool possible(const RandomPath& p, int s) {
  if (s == 0) return p.hittable();
  const int t = p.n - s;
  if (t < 1) return false;
  if (p.n == 2) return p.kind == LightKind::area;
  return !p.delta[static_cast<size_t>(s - 1)] && !p.delta[static_cast<size_t>(s)];
}

// Density of strategy (s, n - s): areas, but a direction at infinity.
double density(const RandomPath& p, int s) {
  double product = 1.0;
  for (int i = 0; i < s; ++i) {  // the light subpath
    const auto k = static_cast<size_t>(i);
    if (i == 0 && s == 1 && p.n > 2) {
      product *= p.probability * p.light_drawn;
      if (!p.infinite()) product *= p.cos_camera[0] / p.distance2[0];
    } else if (i == 0) {
      product *= p.probability * (p.infinite() ? p.toward_camera[0] : p.light_position);
    } else if (i == 1 && p.infinite()) {
      product *= p.light_position * p.cos_light[1] * p.pass[0];
    } else {
      product *= p.toward_camera[k - 1] * p.cos_light[k] * p.pass[k - 1] / p.distance2[k - 1];
    }
  }
  const int t = p.n - s;
  for (int j = 0; j < t; ++j) {  // the camera subpath
    const auto k = static_cast<size_t>(p.n - 1 - j);
    if (j == 0 && t == 1) {
      product *= p.lens_drawn * p.cos_light[k] / p.distance2[k - 1];
    } else if (j == 0) {
      product *= p.lens_position;
    } else if (k == 0 && p.infinite()) {
      product *= p.toward_light[1] * p.pass[0];
    } else {
      product *= p.toward_light[k + 1] * p.cos_camera[k] * p.pass[k] / p.distance2[k];
    }
  }
  return product;
}

double weight_by_definition(const RandomPath& p, int s, bool power) {
  const double own = density(p, s);
  double sum = 0.0;
  for (int k = 0; k < p.n; ++k) {
    if (!possible(p, k)) continue;
    const double ratio = density(p, k) / own;
    sum += power ? ratio * ratio : ratio;
  }
  return 1.0 / sum;
}

// What the subpaths know, by vertex: the light's up to each vertex, and the camera's.
struct Partials {
  Partials(const RandomPath& p, const Mis& mis) : light(p.delta.size()), camera(p.delta.size()) {
    const auto last = static_cast<size_t>(p.n - 1);
    if (p.n > 2) {
      light[1] = mis.first(p.probability * p.light_drawn,
                           p.probability * p.light_position * p.toward_camera[0], p.cos_camera[0],
                           p.cos_light[1] * p.pass[0], p.hittable() ? p.pass[0] : 0.0);
    }
    for (size_t i = 2; i < last; ++i) {
      light[i] = mis.next(light[i - 1], p.toward_camera[i - 1], p.toward_light[i - 1],
                          p.delta[i - 1], p.cos_camera[i - 1] * p.pass[i - 1],
                          p.cos_light[i] * p.pass[i - 1], p.distance2[i - 1]);
    }
    const bool far = p.infinite();
    if (p.n > 2 || !far) {
      camera[last - 1] =
          mis.first(p.lens_drawn, p.lens_position * p.toward_light[last], p.cos_light[last],
                    p.cos_camera[last - 1] * p.pass[last - 1], 0.0);
    }
    for (size_t i = last - 1; i-- > 0;) {
      const bool escapes = i == 0 && far;
      camera[i] =
          mis.next(camera[i + 1], p.toward_light[i + 1], p.toward_camera[i + 1], p.delta[i + 1],
                   p.cos_light[i + 1] * p.pass[i], (escapes ? 1.0 : p.cos_camera[i]) * p.pass[i],
                   escapes ? 1.0 : p.distance2[i]);
    }
  }
  std::vector<MisPartial> light, camera;
};

double weight_by_recursion(const RandomPath& p, const Partials& q, int s, const Mis& mis) {
  const int t = p.n - s;
  const auto y = static_cast<size_t>(s > 0 ? s - 1 : 0), x = static_cast<size_t>(s);
  const double emit = p.light_position * p.toward_camera[0];
  const double lens_emit = p.lens_position * p.toward_light[static_cast<size_t>(p.n - 1)];
  if (s == 0) {
    double connect = p.probability * p.light_drawn;
    if (!p.infinite()) connect *= p.cos_camera[0] / p.distance2[0];
    if (p.n == 2) connect = p.kind == LightKind::area ? p.probability * p.light_position : 0.0;
    return Mis::weight(0.0, mis.on_light(q.camera[0], connect, p.probability * emit));
  }
  if (p.n == 2) {
    const double drawn = p.probability * p.light_position * p.lens_drawn;
    const double met = lens_emit * p.cos_camera[0] * p.pass[0] / (drawn * p.cos_light[1]);
    return Mis::weight(mis.f(met), 0.0);
  }
  if (s == 1) {
    const double hit =
        p.hittable() ? mis.f(p.toward_light[1] * p.pass[0] / (p.probability * p.light_drawn)) : 0.0;
    const double ratio = emit * p.cos_light[1] * p.pass[0] / (p.light_drawn * p.cos_camera[0]);
    return Mis::weight(hit, mis.join(q.camera[1], ratio, p.toward_camera[1]));
  }
  if (t == 1) {
    const double ratio = lens_emit * p.cos_camera[y] * p.pass[y] / (p.lens_drawn * p.cos_light[x]);
    return Mis::weight(mis.join(q.light[y], ratio, p.toward_light[y]), 0.0);
  }
  const double at_y = p.toward_light[x] * p.cos_camera[y] * p.pass[y] / p.distance2[y];
  const double at_x = p.toward_camera[y] * p.cos_light[x] * p.pass[y] / p.distance2[y];
  return Mis::weight(mis.join(q.light[y], at_y, p.toward_light[y]),
                     mis.join(q.camera[x], at_x, p.toward_camera[x]));
}

TEST(Mis, RecursionEqualsDefinition) {
  RandomStream u(7, RandomUse::test);
  for (const bool power : {false, true}) {
    const Mis mis(power ? Mis::Heuristic::power : Mis::Heuristic::balance);
    for (const LightKind kind :
         {LightKind::area, LightKind::point, LightKind::infinite, LightKind::distant}) {
      for (int round = 0; round < 1000; ++round) {
        const RandomPath p(u, kind);
        const Partials q(p, mis);
        double sum = 0.0;
        bool any = false;
        for (int s = 0; s < p.n; ++s) {
          if (!possible(p, s)) continue;
          const double expected = weight_by_definition(p, s, power);
          const double found = weight_by_recursion(p, q, s, mis);
          ASSERT_NEAR(found, expected, 1e-9 * expected)
              << "kind " << static_cast<int>(kind) << " n " << p.n << " s " << s;
          sum += found;
          any = true;
        }
        if (any) {
          ASSERT_NEAR(sum, 1.0, 1e-9);
        }
      }
    }
  }
}

TEST(Mis, StaysFiniteAtExtremes) {
  const Mis mis(Mis::Heuristic::power);
  MisPartial at = mis.first(1e30, 1e-30, 1.0, 1e-6, 1.0);
  for (int i = 0; i < 1000; ++i) at = mis.next(at, 1e-20, 0.0, false, 1.0, 1e-6, 1e20);
  EXPECT_TRUE(std::isfinite(at.connect) && std::isfinite(at.deeper));
  for (int i = 0; i < 1000; ++i) at = mis.next(at, 1e-20, 1e20, i % 2 == 0, 1.0, 1e-6, 1e20);
  EXPECT_TRUE(std::isfinite(at.connect) && std::isfinite(at.deeper));
  const double w = Mis::weight(mis.join(at, 0.0, 1e30), mis.join(at, 1e30, 1e30));
  EXPECT_TRUE(w >= 0.0 && w <= 1.0);
}

TEST(Mis, PowerWeightIsAPartition) {
  EXPECT_FLOAT_EQ(power_weight(3.f, 1.f), 0.9f);
  EXPECT_FLOAT_EQ(power_weight(1.f, 3.f), 0.1f);
  EXPECT_FLOAT_EQ(power_weight(1e30f, 0.f), 1.f);
  EXPECT_FLOAT_EQ(power_weight(1e-30f, 1e30f), 0.f);
}

}  // namespace
}  // namespace pssmlt
