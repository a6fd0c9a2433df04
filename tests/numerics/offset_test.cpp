// Points on surfaces and the offset of rays that leave them, against the surface in 80 bits: the
// bound that a hit carries holds, the offset point lies on the side that the ray leaves to, and the
// ray does not meet its own surface again.
#include <fmt/format.h>

#include <array>

#include "core/base/warp.h"
#include "core/scene/accel.h"
#include "tests/numerics/measured.h"
#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

vec3 random_direction(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  return uniform_sphere({x, y});
}

// Cosine to `n` log-uniform from 1 to 1e-7, on either side.
vec3 grazing_direction(RandomStream& random, const vec3& n) {
  const float cosine = static_cast<float>(spread(random, 1e-7, 1.0));
  const float side = random.next() < 0.5f ? -1.f : 1.f;
  const vec3 along = random_direction(random);
  const vec3 flat = along - n * glm::dot(along, n);
  if (!(glm::length(flat) > 1e-3f)) return side * n;
  return glm::normalize(side * cosine * n +
                        std::sqrt(std::max(0.f, 1.f - cosine * cosine)) * glm::normalize(flat));
}

// Triangles of every shape, down to an aspect of 1e-6, about a point `away` sizes from the origin.
std::string triangles(RandomStream& random, double size, double away, int count) {
  const dvec3 center = size * away * dvec3(random_direction(random));
  std::string points, indices;
  for (int i = 0; i < count; ++i) {
    const double thin = spread(random, 1e-6, 1.0);
    const dvec3 a(random_direction(random)), b(random_direction(random));
    const dvec3 first = center + size * dvec3(random_direction(random));
    std::array<vec3, 3> c = {vec3(first), vec3(first + size * a),
                             vec3(first + size * (0.3 * a + thin * b))};
    for (const vec3& p : c) points += fmt::format("{:.9g} {:.9g} {:.9g} ", p.x, p.y, p.z);
    indices += fmt::format("{} {} {} ", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  return "Shape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices +
         "]";
}

// Of the plane through a triangle, in 80 bits.
struct ExactPlane {
  ExactPlane(const vec3& a, const vec3& b, const vec3& c)
      : origin(a), normal(unit(cross(LongVec(b) - LongVec(a), LongVec(c) - LongVec(a)))) {}
  long double height(const vec3& p) const { return dot(LongVec(p) - origin, normal); }
  LongVec origin, normal;
};

vec2 barycentric_of(RandomStream& random) {
  // Near corners and edges, too.
  float x = static_cast<float>(spread(random, 1e-7, 1.0));
  float y = static_cast<float>(spread(random, 1e-7, 1.0));
  if (random.next() < 0.5f) x = 1.f - x;
  if (x + y > 1.f) y = 1.f - x;
  return {x, std::max(y, 0.f)};
}

struct Count {
  int64_t rays = 0, behind = 0, met_again = 0;
  void print(const char* of) const {
    std::printf("numerics: %s: %lld rays, %lld start behind, %lld meet their own surface\n", of,
                static_cast<long long>(rays), static_cast<long long>(behind),
                static_cast<long long>(met_again));
  }
};

// Height over the longest edge, in units of that edge.
double thinness(const TriangleMesh& mesh, const glm::uvec3& t) {
  const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return glm::length(glm::cross(b - a, c - a)) / (longest * longest);
}

void leave(const Accel& accel, const Hit& hit, const ExactPlane& plane, RandomStream& random,
           Count& count) {
  const vec3 d = grazing_direction(random, hit.ng);
  const float side = glm::dot(d, hit.ng) < 0.f ? -1.f : 1.f;
  const long double outside = dot(plane.normal, LongVec(hit.ng)) < 0.0L ? -1.0L : 1.0L;
  const vec3 origin = offset_origin(hit.position, hit.error, hit.ng, d);
  ++count.rays;
  if (plane.height(origin) * outside * static_cast<long double>(side) < 0.0L) ++count.behind;
  RawHit again;
  if (accel.intersect({origin, d}, again) && again.element == hit.element) ++count.met_again;
}

// Error of the height over the plane: the position's six roundings, gamma(7) of the coordinates
// (docs/numerics.md); the sum of the weights may be off by two roundings, which moves the point in
// the plane's direction by as many units of the plane's distance to the origin.
TEST(Offsets, OfTriangles) {
  RandomStream random(1, RandomUse::test);
  Worst worst("height of a mesh's point over its triangle / hit.error",
              "1 (7 u of the coordinates)");
  Count needles, others;
  for (const double size : {0x1p-20, 0x1p-10, 1.0, 0x1p10, 0x1p20}) {
    for (const double away : {0.0, 1.0, 1e3, 1e6}) {
      const std::string text = triangles(random, size, away, 200);
      const auto shape = make_shape(text);
      const TriangleMesh& mesh = *shape->mesh();  // without those that float coordinates flatten
      const auto kept = static_cast<uint32_t>(mesh.triangles.size());
      ASSERT_GT(kept, 50u);
      Primitive primitive;
      primitive.shape = shape;
      Accel accel;
      accel.build({&primitive}, {}, {});
      for (int i = 0; i < 4000; ++i) {
        Hit hit;
        hit.element = static_cast<uint32_t>(i) % kept;
        shape->fill(barycentric_of(random), hit);
        const glm::uvec3& corner = mesh.triangles[hit.element];
        const ExactPlane plane(mesh.positions[corner.x], mesh.positions[corner.y],
                               mesh.positions[corner.z]);
        const long double bound = static_cast<long double>(glm::dot(glm::abs(hit.ng), hit.error));
        if (bound > 0.0L) worst.add(plane.height(hit.position) / bound, 1.0L);
        const bool thin = thinness(mesh, corner) < 0x1p-13;
        leave(accel, hit, plane, random, thin ? needles : others);
      }
    }
  }
  worst.check();
  needles.print("triangles thinner than 2^-13 of their length");
  others.print("other triangles");
  EXPECT_EQ(needles.behind + others.behind, 0);
  EXPECT_EQ(others.met_again, 0);
  EXPECT_LE(needles.met_again, needles.rays / 1000);
}

// A sphere's point is computed in double and rounded once: half a unit in the last place of each
// coordinate, of which hit.error is four times as much.
TEST(Offsets, OfSpheres) {
  RandomStream random(2, RandomUse::test);
  Worst worst("distance of a sphere's point to it / hit.error", "1/2 (u of the coordinates)");
  Count count;
  for (const double size : {0x1p-20, 0x1p-10, 1.0, 0x1p10, 0x1p20}) {
    for (const double away : {0.0, 1.0, 1e3, 1e6}) {
      const vec3 at = vec3(size * away * dvec3(random_direction(random)));
      const auto shape = make_shape(
          fmt::format("Translate {:.9g} {:.9g} {:.9g} Shape \"sphere\" \"float radius\" {:.9g}",
                      at.x, at.y, at.z, size));
      for (int i = 0; i < 5000; ++i) {
        const float x = random.next();
        const float y = random.next();
        Hit hit;
        shape->fill({x, y}, hit);
        const long double height =
            norm(LongVec(hit.position) - LongVec(at)) - static_cast<long double>(size);
        const long double bound = static_cast<long double>(glm::dot(glm::abs(hit.ng), hit.error));
        worst.add(height / bound, 0.5L + 1e-3L);
        const vec3 d = grazing_direction(random, hit.ng);
        const float side = glm::dot(d, hit.ng) < 0.f ? -1.f : 1.f;
        const vec3 origin = offset_origin(hit.position, hit.error, hit.ng, d);
        ++count.rays;
        const long double after =
            norm(LongVec(origin) - LongVec(at)) - static_cast<long double>(size);
        if (after * static_cast<long double>(side) < 0.0L) ++count.behind;
        const auto again = shape->intersect({origin, d, infinity}, 0x1p-80f);
        // From outside the sphere is not met at all, from inside on the other side.
        if (side > 0.f && again) ++count.met_again;
      }
    }
  }
  worst.check();
  count.print("spheres");
  EXPECT_EQ(count.behind, 0);
  EXPECT_EQ(count.met_again, 0);
}

}  // namespace
}  // namespace pssmlt
