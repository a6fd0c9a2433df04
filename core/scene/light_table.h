// The choice among lights: by power for emission, and for next event estimation, if there are many
// of them, by what they may do where the light is wanted (core/scene/light_tree.h).
#pragma once

#include <optional>
#include <vector>

#include "core/base/distribution.h"
#include "core/light.h"
#include "core/scene/light_tree.h"

namespace pssmlt {

// How next event estimation chooses lights.
enum class LightPick {
  bvh,    // by the hierarchy; by power where there are less than LightTable::many lights
  power,  // as for emission
  uniform
};

// Where a light stands in a list, by its address: asked at every vertex of light subpaths, for
// which std::unordered_map's division and its walk through memory take too long.
class LightIndex {
 public:
  LightIndex() = default;
  // The first of equal ones counts.
  explicit LightIndex(const std::vector<const Light*>& lights);
  std::optional<size_t> find(const Light* light) const {
    for (size_t slot = first_slot(light); slots_[slot].light; slot = (slot + 1) & mask_) {
      if (slots_[slot].light == light) return slots_[slot].index;
    }
    return std::nullopt;
  }

 private:
  struct Slot {
    const Light* light = nullptr;  // null: free
    size_t index = 0;
  };
  size_t first_slot(const Light* light) const {
    // Fibonacci hashing (Knuth, The Art of Computer Programming 3, section 6.4).
    const auto address = static_cast<uint64_t>(reinterpret_cast<uintptr_t>(light));
    return static_cast<size_t>(address * 0x9e3779b97f4a7c15u >> 32) & mask_;
  }
  size_t mask_ = 0;
  std::vector<Slot> slots_{Slot{}};  // at least half of them free
};

class LightTable {
 public:
  // From so many lights with known bounds on there is a hierarchy.
  static constexpr size_t many = 8;

  LightTable() = default;
  // Probability of a light by power: 0.9 by power + 0.1 uniform, so that a weak light near the
  // camera is never starved. Lights without power are left out. `bounds`: the scene's, where the
  // power of infinite lights comes in.
  explicit LightTable(const std::vector<const Light*>& lights, const SceneBounds& bounds = {});

  struct Choice {
    const Light* light = nullptr;
    float probability = 0.f;
    float emission = 0.f;  // probability of choosing it to emit
  };
  // For emission: light == nullptr only if there are no lights. `u` in [0,1).
  Choice choose(double u) const;
  // Probability of choosing this light to emit; 0 if it is not in the table.
  float probability(const Light* light) const;
  // The same for next event estimation at a receiver. Positive for every light of the table.
  Choice choose(LightPick pick, const LightReceiver& at, double u) const;
  float probability(LightPick pick, const LightReceiver& at, const Light* light) const;
  // True if the receiver makes a difference; if not, only its position is ever read (by lights).
  bool by_place(LightPick pick) const { return pick == LightPick::bvh && !tree_.empty(); }

  const std::vector<const Light*>& all() const { return lights_; }
  const std::vector<const Light*>& infinite() const { return infinite_; }
  bool empty() const { return lights_.empty(); }

 private:
  // What choose_by_place() decides first: the share of this is the choice by power, a defence
  // against all that the hierarchy does not know, occlusion above all (Hesterberg 1995, Weighted
  // Average Importance Sampling and Defensive Mixture Distributions).
  static constexpr double defence = 0.05;

  void set_probabilities(const std::vector<double>& power);
  void build_tree(const std::vector<double>& power, const SceneBounds& bounds);
  size_t index_of(double u) const;
  Choice choose_by_place(const LightReceiver& at, double u) const;
  double probability_by_place(const LightReceiver& at, size_t light) const;
  // Share of the lights outside the hierarchy in what is chosen by place.
  double outside_share(const LightReceiver& at) const;

  std::vector<const Light*> lights_, infinite_;
  std::vector<float> probability_;
  std::vector<double> cdf_;
  LightIndex index_;

  LightTree tree_;
  std::vector<size_t> inside_, outside_;  // lights of the hierarchy and the others
  std::vector<uint32_t> place_;           // of a light in inside_ or outside_
  std::vector<bool> in_tree_;
  Distribution1D outside_power_;
  double outside_irradiance_ = 0.0;  // of the lights outside the hierarchy [W/m^2]
};

}  // namespace pssmlt
