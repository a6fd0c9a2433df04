// Curves with a width: round tubes and flat ribbons along Bezier curves or uniform B-splines of
// degree 2 or 3, made of triangles whose number follows how much the curve bends.
//
// Source: parameters as in pbrt-v4, whose "flat" is a ribbon that turns toward every ray. That is
// no surface that rays from both ends of a path could agree on, so "flat" is a tube here, as
// "cylinder" is: as wide from everywhere, with the light and shade of a round thread. Tubes are
// open at their ends. Costs memory: some hundred bytes a triangle, 16 triangles a step along the
// curve.
//
// What is hair has to be crossed once, not where a path enters and where it leaves. As a "sheet" a
// tube becomes a flat band that turns about the curve, pi/2 times as wide: over a turn it hides as
// much as the tube, from everywhere, and all rays agree on it.
#include <algorithm>
#include <array>

#include "core/fibre.h"
#include "core/plugin/plugin.h"
#include "core/shapes/mesh_shape.h"

namespace pssmlt {
namespace {

constexpr int sides = 8;            // of a tube
constexpr int most_steps = 256;     // of a segment
constexpr double tolerance = 0.01;  // of the distance to the true curve, in widths
constexpr double most_turn = 0.2;   // of a ribbon's normal in a step [rad]
constexpr double pitch = 6.0;       // of a sheet: widths of the fibre a half turn

struct CurveData {
  std::vector<dvec3> points;   // control points
  std::vector<dvec3> normals;  // ribbons: at the ends of the segments, unit
  int degree = 3, segments = 1;
  bool spline = false;  // B-spline, else Bezier
  bool ribbon = false;
  bool sheet = false;  // of a fibre
  double width0 = 1.0, width1 = 1.0;
};

// Of the control points of a segment at u in [0, 1]; and their derivatives.
using Weights = std::array<double, 4>;
Weights weights(bool spline, int degree, double u) {
  const double s = 1.0 - u;
  if (degree == 2 && spline) return {0.5 * s * s, 0.5 + u * s, 0.5 * u * u, 0.0};
  if (degree == 2) return {s * s, 2.0 * u * s, u * u, 0.0};
  if (!spline) return {s * s * s, 3.0 * s * s * u, 3.0 * s * u * u, u * u * u};
  return {s * s * s / 6.0, (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0,
          (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, u * u * u / 6.0};
}
Weights slopes(bool spline, int degree, double u) {
  const double s = 1.0 - u;
  if (degree == 2 && spline) return {-s, s - u, u, 0.0};
  if (degree == 2) return {-2.0 * s, 2.0 * (s - u), 2.0 * u, 0.0};
  if (!spline) return {-3.0 * s * s, 3.0 * s * (s - 2.0 * u), 3.0 * u * (2.0 * s - u), 3.0 * u * u};
  return {-0.5 * s * s, (-4.0 * u + 3.0 * u * u) / 2.0, (4.0 * s - 3.0 * s * s) / 2.0, 0.5 * u * u};
}

// A cross section: centre, unit directions along and across the curve, and where on the segment.
struct Section {
  dvec3 center, along, across;
  double u = 0.0, width = 0.0;
};

class CurveMesher {
 public:
  explicit CurveMesher(CurveData data) : data_(std::move(data)) {
    if (data_.sheet) phase_ = first_phase();
  }

  MeshData make() {
    for (int segment = 0; segment < data_.segments; ++segment) {
      const int steps = steps_of(segment);
      turn_ = turn(segment);
      for (int i = 0; i <= steps; ++i) {
        add(section(segment, static_cast<double>(i) / steps));
        if (i > 0) join();
      }
      phase_ += turn_;
    }
    return std::move(mesh_);
  }

 private:
  const dvec3& point(int segment, int k) const {
    return data_.points[static_cast<size_t>(segment * (data_.spline ? 1 : data_.degree) + k)];
  }
  dvec3 sum(int segment, const Weights& w) const {
    dvec3 total(0.0);
    for (int k = 0; k <= data_.degree; ++k) total += w[static_cast<size_t>(k)] * point(segment, k);
    return total;
  }

  // A curve of degree d is no further from n chords than d (d - 1) / (8 n^2) times the largest
  // second difference of its Bezier points; a B-spline's are smaller.
  int steps_of(int segment) const {
    double bend = 0.0;
    for (int k = 0; k + 2 <= data_.degree; ++k)
      bend = std::max(bend, glm::length(point(segment, k) - 2.0 * point(segment, k + 1) +
                                        point(segment, k + 2)));
    const double width = std::max(data_.width0, data_.width1);
    double steps = std::sqrt(data_.degree * (data_.degree - 1) / 8.0 * bend / (tolerance * width));
    if (data_.ribbon) steps = std::max(steps, twist(segment) / most_turn);
    if (data_.sheet) steps = std::max(steps, turn(segment) / most_turn);
    return static_cast<int>(std::clamp(std::ceil(steps), 1.0, static_cast<double>(most_steps)));
  }
  // Angle between the normals at a segment's ends [rad].
  double twist(int segment) const {
    const auto i = static_cast<size_t>(segment);
    return std::acos(std::clamp(glm::dot(data_.normals[i], data_.normals[i + 1]), -1.0, 1.0));
  }
  // Angle by which a sheet turns on a segment [rad], no more than its steps can follow.
  double turn(int segment) const {
    if (!data_.sheet) return 0.0;
    double length = 0.0;
    for (int k = 0; k < data_.degree; ++k)
      length += glm::distance(point(segment, k), point(segment, k + 1));
    const double width = 0.5 * (data_.width0 + data_.width1);
    return std::min(std::numbers::pi * length / (pitch * width), most_steps * most_turn);
  }
  // Where it starts, so that neighbours are not turned alike.
  double first_phase() const {
    const dvec3 p = data_.points[0] / std::max(data_.width0, data_.width1);
    const double t = glm::dot(p, dvec3(0.7548776662, 0.5698402910, 0.4301597090));
    return 2.0 * std::numbers::pi * (t - std::floor(t));
  }
  // Between them, at constant speed.
  dvec3 normal(int segment, double u) const {
    const auto i = static_cast<size_t>(segment);
    const double angle = twist(segment), sine = std::sin(angle);
    if (!(sine > 1e-6)) return data_.normals[i];
    return (std::sin((1.0 - u) * angle) * data_.normals[i] +
            std::sin(u * angle) * data_.normals[i + 1]) /
           sine;
  }

  Section section(int segment, double u) {
    Section s;
    s.u = u;
    s.center = sum(segment, weights(data_.spline, data_.degree, u));
    const double part = (segment + u) / data_.segments;
    s.width = (1.0 - part) * data_.width0 + part * data_.width1;
    const dvec3 slope = sum(segment, slopes(data_.spline, data_.degree, u));
    const double speed = glm::length(slope);
    // Where the curve stands still it goes on as before, or toward the segment's end.
    s.along = last_.along;
    if (speed > 0.0) {
      s.along = slope / speed;
    } else if (glm::length(last_.along) == 0.0) {
      const dvec3 d = point(segment, data_.degree) - point(segment, 0);
      s.along = glm::length(d) > 0.0 ? glm::normalize(d) : dvec3(0.0, 0.0, 1.0);
    }
    s.across = across(s, segment);
    last_ = s;
    return s;
  }
  // Ribbons: perpendicular to their normal. Tubes: the last one, turned no more than the curve is.
  dvec3 across(const Section& s, int segment) const {
    const dvec3 wanted = data_.ribbon ? glm::cross(normal(segment, s.u), s.along) : last_.across;
    const dvec3 flat = wanted - s.along * glm::dot(wanted, s.along);
    if (glm::length(flat) > 1e-9) return glm::normalize(flat);
    const dvec3 axis = std::abs(s.along.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(s.along, axis));
  }

  // A flat cross section.
  void add_band(const Section& s, const dvec3& across, double width) {
    const dvec3 up = glm::cross(s.along, across);
    add_vertex(s, s.center - 0.5 * width * across, up, 0.0);
    add_vertex(s, s.center + 0.5 * width * across, up, 1.0);
  }
  void add_vertex(const Section& s, const dvec3& position, const dvec3& normal, double v) {
    mesh_.mesh.positions.emplace_back(position);
    mesh_.mesh.normals.emplace_back(normal);
    mesh_.mesh.uvs.emplace_back(s.u, v);
    mesh_.tangents.emplace_back(s.along);
  }
  void add(const Section& s) {
    const dvec3 up = glm::cross(s.along, s.across);
    if (data_.ribbon) return add_band(s, s.across, s.width);
    if (data_.sheet) {
      const double angle = phase_ + s.u * turn_;
      const dvec3 turned = std::cos(angle) * s.across + std::sin(angle) * up;
      // Seen from all sides alike a band of width w hides 2/pi w.
      return add_band(s, turned, 0.5 * std::numbers::pi * s.width);
    }
    // As wide in the mean over all directions as the round tube.
    constexpr double half_angle = std::numbers::pi / sides;
    const double radius = 0.5 * s.width * half_angle / std::sin(half_angle);
    for (int i = 0; i <= sides; ++i) {
      const double angle = 2.0 * half_angle * (i % sides);
      const dvec3 out = std::cos(angle) * s.across - std::sin(angle) * up;
      add_vertex(s, s.center + radius * out, out, static_cast<double>(i) / sides);
    }
  }
  // The last two cross sections.
  void join() {
    const auto row = static_cast<uint32_t>(data_.ribbon || data_.sheet ? 2 : sides + 1);
    const auto end = static_cast<uint32_t>(mesh_.mesh.positions.size());
    for (uint32_t a = end - 2 * row; a + 1 < end - row; ++a) {
      mesh_.mesh.triangles.emplace_back(a, a + row, a + 1);
      mesh_.mesh.triangles.emplace_back(a + 1, a + row, a + row + 1);
    }
  }

  CurveData data_;
  Section last_{dvec3(0.0), dvec3(0.0), dvec3(0.0)};
  double phase_ = 0.0, turn_ = 0.0;  // of a sheet: at the segment's start, and on its way [rad]
  MeshData mesh_;
};

void check_points(const Parameters& p, CurveData& data) {
  const auto count = static_cast<int>(data.points.size());
  if (count == 0) p.fail("P", "control points \"P\" are missing or empty");
  const bool fits =
      data.spline ? count > data.degree : count > data.degree && (count - 1) % data.degree == 0;
  if (!fits)
    p.fail("P", std::to_string(count) + " control points: degree " + std::to_string(data.degree) +
                    (data.spline ? " needs one more, or more than that"
                                 : " needs one more than it or a multiple of it"));
  data.segments = data.spline ? count - data.degree : (count - 1) / data.degree;
}

void check_normals(const Parameters& p, CurveData& data) {
  if (!data.ribbon) {
    if (!data.normals.empty()) p.fail("N", "only ribbons have normals \"N\"");
    return;
  }
  if (data.normals.size() != static_cast<size_t>(data.segments) + 1)
    p.fail("N", "a ribbon of " + std::to_string(data.segments) + " segments needs " +
                    std::to_string(data.segments + 1) + " normals \"N\"");
  for (dvec3& n : data.normals) {
    if (!(glm::length(n) > 0.0)) p.fail("N", "a normal has no length");
    n = glm::normalize(n);
  }
}

MeshData read(Parameters& p) {
  constexpr std::array<std::string_view, 3> types = {"flat", "ribbon", "cylinder"};
  constexpr std::array<std::string_view, 2> bases = {"bezier", "bspline"};
  CurveData data;
  data.ribbon = p.choice("type", "flat", types, "flat and cylinder: round tubes") == "ribbon";
  data.spline = p.choice("basis", "bezier", bases, "What the control points are.") == "bspline";
  data.sheet = p.flag(fibre_parameter, false,
                      "flat and cylinder: a band that turns about the curve and is crossed once; "
                      "default: true with materials of fibres") &&
               !data.ribbon;
  data.degree = p.integer("degree", 3, "", "2 or 3.");
  for (const vec3& v : p.points3("P", "m", "Control points.")) data.points.emplace_back(v);
  for (const vec3& n : p.normals("N", "Ribbons: normals at the ends of the segments."))
    data.normals.emplace_back(n);
  const float width = p.number("width", 1.f, "m", "Diameter.");
  data.width0 =
      static_cast<double>(p.number("width0", width, "m", "At the start; default: width."));
  data.width1 = static_cast<double>(p.number("width1", width, "m", "At the end; default: width."));
  p.integer("splitdepth", 3, "", "Without effect: curves are divided by how they bend.");
  if (data.degree != 2 && data.degree != 3) p.fail("degree", "\"degree\" must be 2 or 3");
  if (!(data.width0 >= 0.0)) p.fail("width0", "widths must not be negative");
  if (!(data.width1 >= 0.0)) p.fail("width1", "widths must not be negative");
  if (p.describing()) return {};
  if (!(std::max(data.width0, data.width1) > 0.0)) p.fail("width", "the curve has no width");
  check_points(p, data);
  check_normals(p, data);
  return CurveMesher(std::move(data)).make();
}

class Curve final : public MeshShape {
 public:
  static constexpr const char* summary = "Tube or ribbon along a Bezier curve or B-spline";
  explicit Curve(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "curve", pssmlt::Curve)
