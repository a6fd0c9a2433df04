// A hierarchy of lights: which of many may matter at a point, found in logarithmic time.
//
// Sources: A. Conty Estevez and C. Kulla 2018, Importance Sampling of Many Lights with Adaptive
// Tree Splitting (cones of normals, orientation in the cost of a split); Pharr, Jakob, Humphreys
// 2023, Physically Based Rendering, section 12.6.3 (one number down the tree). Every node has a
// box, a cone of normals and an intensity; a child is chosen in proportion to a guess of the
// irradiance that its lights make at the point, nothing being in the way. Nodes have up to eight
// children, guessed at by the same instructions (I. Wald, C. Benthin, S. Boulos 2008, Getting Rid
// of Packets, did so with trees of boxes).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/four.h"
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
    double probability = 0.0;  // as probability() says, up to the rounding of doubles
  };
  // u in [0,1); the only number that is drawn.
  Choice choose(const LightReceiver& at, double u) const;
  // Sums to 1 over all lights, for every receiver; 0 only where bounds show that a light cannot
  // shine there.
  double probability(const LightReceiver& at, uint32_t light) const;
  // Guess of the irradiance from all lights [W/m^2].
  double irradiance(const LightReceiver& at) const;

  bool empty() const { return fans_.empty(); }
  size_t bytes() const {
    return fans_.capacity() * sizeof(Fan) + lights_.capacity() * sizeof(Place);
  }

 private:
  static constexpr uint32_t width = 8;
  // Four siblings. What is not there has no intensity.
  struct Half {
    std::array<Four, 3> center{};  // of the bounding spheres, by axis [m]
    Four radius2{};                // their squared radii [m^2]
    std::array<Four, 3> axis{};    // of the cones of normals
    Four cos_cone{}, sin_cone{};   // of their half angles
    Four cos_spread{};
    Four intensity{};  // as a part of that of all lights [1]
    Four two_sided{};  // 0 or 1
  };
  struct Place {
    uint32_t fan = 0, lane = 0;
  };
  struct alignas(64) Fan {
    std::array<Half, 2> half{};
    std::array<uint32_t, width> next{};  // inner node: the fan of its children; leaf: the light
    std::array<bool, width> leaf{};
    uint32_t count = 0;
    Place at;  // of its parent; the root's: unused
  };
  friend class LightTreeBuilder;
  // Irradiance of each sibling for unit intensity of all lights together [1/m^2].
  static Four importances(const Half& half, const LightReceiver& at);
  // What siblings are chosen in proportion to.
  struct Weights {
    std::array<double, width> up_to{};  // sums of those up to each
    double sum() const { return up_to.back(); }
    double before(uint32_t i) const { return i == 0 ? 0.0 : up_to[i - 1]; }
    double of(uint32_t i) const { return up_to[i] - before(i); }
    // False unless the sum is positive and finite.
    bool add(const std::array<Four, 2>& guess);
  };
  // Their sum is positive and finite.
  static Weights weights(const Fan& fan, const LightReceiver& at);

  std::vector<Fan> fans_;  // the root's first
  std::vector<Place> lights_;
  double intensity_ = 0.0;  // of all lights [W/sr]
};

}  // namespace pssmlt
