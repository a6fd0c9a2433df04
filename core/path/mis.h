// Multiple importance sampling (Veach 1997, chapter 9) and its recursive form for bidirectional
// paths, in ratios of densities and in double.
#pragma once

#include <algorithm>

namespace pssmlt {

// Power heuristic, beta = 2, of a technique with density p against another with density q.
inline float power_weight(float p, float q) {
  const double r = static_cast<double>(q) / static_cast<double>(p);
  return static_cast<float>(1.0 / (1.0 + r * r));
}

// What a subpath knows of all strategies that would have sampled fewer of its vertices: the
// quantities dVCM and dVC of Georgiev et al. 2012, "Implementing Vertex Connection and Merging",
// section 4, without merging. `connect` covers the strategy that joins the last edge, `deeper` all
// those further back. With the weight function f(r) = r (balance) or r^2 (power heuristic), the
// ratios of those strategies to one that keeps the whole subpath sum up to
//   f(density of this vertex from the other side, per area) *
//   (connect + f(density of the vertex before, from here, per solid angle) * deeper).
struct MisPartial {
  double connect = 0.0;
  double deeper = 0.0;
};

class Mis {
 public:
  enum class Heuristic { balance, power };
  explicit Mis(Heuristic heuristic) : power_(heuristic == Heuristic::power) {}

  // f(ratio), kept finite so that a vanishing ratio never meets an infinity.
  double f(double ratio) const { return std::min(power_ ? ratio * ratio : ratio, 0x1p500); }

  // After the first edge. connect: density of drawing the endpoint from the first vertex [1/sr, or
  // as Toward::pdf_toward], 0 if no strategy does; emit: pdf_position * pdf_direction; cosine at
  // the endpoint (geometric); arrival: Surface::arrival() of the vertex; pass: probability that a
  // path from the other side gets to the endpoint through media, 0 if none can end on it.
  // The length of the edge cancels, also for endpoints at infinity.
  MisPartial first(double connect, double emit, double cos_endpoint, double arrival,
                   double pass) const {
    const double density = emit * arrival / cos_endpoint;
    return {f(connect / density), f(pass / density)};
  }

  // After an edge from a scattering vertex with `from`: pdf of the direction taken [1/sr; delta: 1]
  // and of the reverse, Surface::arrival() (without media the geometric cosine) at the edge's start
  // and end, squared length. A light at infinity that the edge ends on: distance2 = 1 and cos_end
  // the probability of getting there through media.
  MisPartial next(const MisPartial& from, double pdf, double pdf_reverse, bool delta,
                  double cos_start, double cos_end, double distance2) const {
    const double back = f(pdf_reverse) * from.deeper;
    const double density = pdf * cos_end;
    return {delta ? 0.0 : f(distance2 / density),
            bounded(f(cos_start / density) * (delta ? back : from.connect + back))};
  }

  // After a way beneath a surface (core/path/way_beneath.h) from the vertex with `from`: pdf of
  // going beneath [1] and, of the reverse, of leaving toward the vertex before [1/sr]. No strategy
  // joins its ends, and the density of the other end is the same both ways.
  MisPartial beneath(const MisPartial& from, double pdf, double pdf_reverse) const {
    return {0.0, bounded(f(1.0 / pdf) * (from.connect + f(pdf_reverse) * from.deeper))};
  }

  // Sum of ratios for a subpath that ends in `at`: density of its last vertex from the other side
  // [1/m^2, or a ratio where the edge's length cancels] and of the one before [1/sr].
  double join(const MisPartial& at, double density, double pdf_reverse) const {
    return f(density) * (at.connect + f(pdf_reverse) * at.deeper);
  }
  // Same for a camera subpath whose last vertex lies on a light: connect: density of drawing that
  // point from the vertex before [1/m^2; at infinity 1/sr]; emit: pdf_position * pdf_direction.
  double on_light(const MisPartial& at, double connect, double emit) const {
    return f(connect) * at.connect + f(emit) * at.deeper;
  }
  static double weight(double light_side, double camera_side) {
    return 1.0 / (1.0 + light_side + camera_side);
  }

 private:
  static double bounded(double x) { return std::min(x, 0x1p500); }
  bool power_;
};

}  // namespace pssmlt
