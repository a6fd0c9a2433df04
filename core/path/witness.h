// Who spoilt a sample. A dropped sample is evaluated once more while a Witness looks at what
// materials, media and lights return; the first value that cannot be, in the order in which the
// path is made, names the culprit. Nothing is looked at otherwise.
#pragma once

#include <atomic>
#include <deque>
#include <string>

#include "core/bsdf.h"
#include "core/plugin/plugin_name.h"

namespace pssmlt {

class Witness {
 public:
  // Looks on while it lives, on the thread that made it. Witnesses do not nest.
  Witness();
  ~Witness();
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  // The one of this thread; null nearly always, which costs one look at a counter to find out.
  static Witness* here() { return alive_.load(std::memory_order_relaxed) == 0 ? nullptr : find(); }
  // The same Bsdf, with its answers looked at; lives as long as the witness.
  const Bsdf* watch(const Bsdf& bsdf, const PluginNamed& plugin);
  void look_at(const Rgb& value, const PluginNamed& plugin);
  void look_at(float density, const PluginNamed& plugin);
  // Of what threw, where nothing was returned.
  void accuse(const PluginNamed& plugin);
  // Empty: all that was returned could be.
  const std::string& culprit() const { return culprit_; }

 private:
  class WatchedBsdf final : public Bsdf {
   public:
    WatchedBsdf(const Bsdf& bsdf, const PluginNamed& plugin, Witness& witness)
        : bsdf_(bsdf), plugin_(plugin), witness_(witness) {}
    Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override;
    float pdf(const vec3& wo, const vec3& wi) const override;
    BothWays both_ways(const vec3& wo, const vec3& wi, Transport mode) const override;
    std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                     Transport mode) const override;
    bool connectible() const override { return bsdf_.connectible(); }
    Rgb albedo(const vec3& wo) const override { return bsdf_.albedo(wo); }

   private:
    template <typename F>
    auto answer(const F& ask) const;
    const Bsdf& bsdf_;
    const PluginNamed& plugin_;
    Witness& witness_;
  };
  static Witness* find();
  static std::atomic<int> alive_;
  std::deque<WatchedBsdf> watched_;  // in place: vertices point at them
  std::string culprit_;
};

}  // namespace pssmlt
