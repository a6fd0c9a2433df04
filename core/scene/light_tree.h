// A hierarchy of lights: which of many may matter at a point, found in logarithmic time.
//
// Sources: A. Conty Estevez and C. Kulla 2018, Importance Sampling of Many Lights with Adaptive
// Tree Splitting (cones of normals, orientation in the cost of a split); Pharr, Jakob, Humphreys
// 2023, Physically Based Rendering, section 12.6.3 (one number down the tree). Every node has a
// box, a cone of normals and an intensity; a child is chosen in proportion to a guess of the
// irradiance that its lights make at the point, nothing being in the way.
#pragma once

#include <cstdint>
#include <vector>

#include "core/light.h"

namespace pssmlt {

// Where light is received.
struct LightReceiver {
  vec3 position{0.f};      // render space [m]
  vec3 normal{0.f};        // unit, on the side that is lit; zero: lit from all around alike
  bool transmits = false;  // lit from both sides of the normal
};

class LightTree {
 public:
  LightTree() = default;
  // `lights`: two or more, each with a positive intensity. O(n log n), deterministic.
  explicit LightTree(const std::vector<LightBounds>& lights);

  struct Choice {
    uint32_t light = 0;        // index into the constructor's argument
    double probability = 0.0;  // the same as probability() says
  };
  // u in [0,1); the only number that is drawn.
  Choice choose(const LightReceiver& at, double u) const;
  // Sums to 1 over all lights, for every receiver; 0 only where bounds show that a light cannot
  // shine there.
  double probability(const LightReceiver& at, uint32_t light) const;
  // Guess of the irradiance from all lights [W/m^2].
  double irradiance(const LightReceiver& at) const;

  bool empty() const { return nodes_.empty(); }
  size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + trails_.capacity() * sizeof(uint64_t);
  }

 private:
  struct alignas(64) Node {
    vec3 center{0.f};      // of the bounding sphere [m]
    float radius2 = 0.f;   // its squared radius [m^2]
    vec3 axis{0.f};        // of the cone of normals
    float cos_cone = 1.f;  // of its half angle
    float cos_spread = 0.f;
    float intensity = 0.f;  // as a part of that of all lights [1]
    uint32_t next = 0;      // inner node: the first of two children; leaf: the light
    bool leaf = false;
    bool two_sided = false;
  };
  friend class LightTreeBuilder;
  // Irradiance for unit intensity of all lights together [1/m^2].
  static float importance(const Node& node, const LightReceiver& at);
  // Probability of the first of two children.
  double first_share(uint32_t first, const LightReceiver& at) const;

  std::vector<Node> nodes_;  // the root first, siblings side by side
  // For each light which way to go from the root, lowest bit first.
  std::vector<uint64_t> trails_;
  double intensity_ = 0.0;  // of all lights [W/sr]
};

}  // namespace pssmlt
