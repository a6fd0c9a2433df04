// The sampler that leaves bright samples' excess to long Markov chains.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/excess/excess_limit.h"
#include "core/excess/excess_plan.h"
#include "core/metropolis/chain_population.h"
#include "core/sampling/sobol_sweeps.h"

namespace pssmlt {

struct ExcessSettings {
  PopulationSettings chains;
  int samples = 16, pilot_samples = 0;
  float threshold = 0.f, share = 0.f, stickiness = 0.f;
};

// Sobol' points for what is below the limit.
class BelowLimit final : public SobolSweeps {
 public:
  BelowLimit(const char* name, const ExcessLimit& limit, double spp, uint64_t seed)
      : SobolSweeps(name, spp, seed), limit_(limit) {}

 private:
  double reshape(Splats& splats, const PixelCredit& camera) const override {
    (void)limit_.keep_below(splats, camera);
    return 0.0;  // chains add the rest
  }
  const ExcessLimit& limit_;
};

class ExcessSampler : public Sampler {
 public:
  // name: of the plugin; static.
  ExcessSampler(const char* name, Parameters& parameters);

  void start(const SamplerContext& context) override;
  double default_spp() const override { return settings_.samples; }
  // Chains first: their units are the longer ones.
  int units(int64_t round) const override { return chain_units() + below_.units(round); }
  double samples(int64_t round) const override;
  void run(int64_t round, int unit, SplatSink& sink, Worker& worker) override;
  int planes() const override { return most_planes; }
  int subsets() const override { return below_.subsets(); }
  int subset_of(int pixel) const override { return below_.subset_of(pixel); }
  double scale(int plane, int subset, int64_t rounds) const override;
  double group_scale(int plane, int group, int64_t rounds) const override;
  // Chains are independent of one another, so that any two groups of them make a pair.
  bool pairs_groups() const override { return true; }
  double scale_relative_variance() const override;
  bool is_chain() const override { return true; }
  bool is_chain_plane(int plane) const override { return plane >= below_.planes(); }
  double mutations(int64_t rounds) const override { return mutations_a_round() * double(rounds); }
  double visits(const dvec2& place) const override { return 1.0 / plan_.mean.at(corner_ + place); }
  void save(Archive& archive) const override { chains_.save(archive); }
  void load(Archive& archive) override { chains_.load(archive); }
  bool replay(const std::string& key, Worker& worker) override {
    return below_.replay(key, worker) || chains_.replay(key, worker);
  }
  std::vector<std::string> warnings() const override;
  std::string unknown_error() const override;
  std::string remedy() const override { return chains_.remedy(); }
  void report(nlohmann::json& statistics) const override;

 private:
  // Two of the sweeps, on large pictures, and two of the chains, with Kelemen's weights.
  static constexpr int most_planes = 4;
  int chain_units() const { return split() ? chains_.units() : 0; }
  double mutations_a_round() const { return split() ? chains_.mutations() : 0.0; }
  bool split() const { return limit_.finite(); }
  // Share of the light that is above the limit, as the pilot found it.
  double excess() const {
    return plan_.light > 0.0 ? std::min(1.0, plan_.split.variances.excess / plan_.light) : 0.0;
  }
  void choose(const SamplerContext& context);
  void start_chains(const SamplerContext& context);
  void tell() const;

  const char* name_;
  ExcessSettings settings_;
  ExcessLimit limit_;
  ExcessPlan plan_;
  dvec2 corner_{0.0};  // of the window [pixels]
  int sweeps_ = 1;     // of a round; more than one where the chains could not take shorter turns
  BelowLimit below_;
  AboveLimit above_;
  ChainPopulation chains_;
};

}  // namespace pssmlt
