// Several integrators that estimate the same light, among which a sampler chooses.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/integrator.h"

namespace pssmlt {

// Its samples are those of the one chosen. Alternatives are those of the integrators given that
// miss nothing of the scene's light that another one finds, in the order of their numbers of
// classes of paths, the most first; that one alone if they find different things, and never one
// whose estimate changes between rounds, or that is made for chains, if another is left.
class IntegratorChoice final : public Integrator {
 public:
  struct Named {
    std::string name;
    std::shared_ptr<Integrator> integrator;
  };
  // At least one; all with the same limits.
  explicit IntegratorChoice(std::vector<Named> all) : all_(std::move(all)) {}
  void prepare(const Scene& scene) override;
  void sample(PrimarySample& u, Splats& out, Workspace& workspace) const override;
  std::string sees() const override { return chosen().sees(); }
  bool splats_light() const override;
  const PathLimits& limits() const override { return chosen().limits(); }
  int alternatives() const override { return static_cast<int>(all_.size()); }
  void choose(int alternative) override {
    chosen_ = static_cast<size_t>(alternative);
    take_name(chosen());
  }
  std::string alternative_name(int alternative) const override {
    return all_[static_cast<size_t>(alternative)].name;
  }
  int passes(int64_t round) const override { return chosen().passes(round); }
  void pass(int64_t round, int unit, PrimarySample& u) override { chosen().pass(round, unit, u); }
  void merge_passes(int64_t round) override { chosen().merge_passes(round); }
  bool fixed() const override { return chosen().fixed(); }
  void save(Archive& archive) const override { chosen().save(archive); }
  void load(Archive& archive) override { chosen().load(archive); }

 private:
  template <typename Good>
  void keep_if_any(const Good& good);
  Integrator& chosen() const { return *all_[chosen_].integrator; }
  std::vector<Named> all_;
  size_t chosen_ = 0;
};

}  // namespace pssmlt
