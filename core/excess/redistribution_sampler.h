// The sampler that spreads bright samples' excess by short chains: what "erpt" and "auto" have in
// common.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/excess/excess_limit.h"
#include "core/excess/redistribution.h"
#include "core/excess/redistribution_plan.h"
#include "core/sampling/sobol_sweeps.h"

namespace pssmlt {

struct RedistributionSamplerSettings {
  RedistributionPlanSettings plan;
  int samples = 16, seed = 0;
};
RedistributionSamplerSettings read_redistribution(Parameters& parameters);

class RedistributionSampler : public SobolSweeps {
 public:
  enum class Chains : uint8_t { always, where_allowed };
  // name: of the plugin; static. where_allowed: no chains, instead of an error, under integrators
  // whose estimate changes from round to round and where samples are clamped.
  RedistributionSampler(const char* name, const RedistributionSamplerSettings& settings,
                        Chains chains);
  void start(const SamplerContext& context) override;
  // Samples and mutations together, as many of these as are expected.
  double samples(int64_t round) const override { return SobolSweeps::samples(round) * work_; }
  bool is_chain() const override { return use_ == Chains::always; }
  bool correlates_pixels() const override { return limit_.finite(); }
  // There is no chain whose moves would have to be judged.
  bool is_chain_plane(int) const override { return false; }
  double mutations(int64_t) const override { return 0.0; }
  std::vector<std::string> warnings() const override;
  std::string unknown_error() const override;
  void report(nlohmann::json& statistics) const override;

 private:
  double reshape(Splats& splats, const PixelCredit& camera) const override {
    return limit_.keep_below(splats, camera);
  }
  void add_rest(const SampleId& id, double rest, int plane, SplatSink& sink,
                Worker& worker) const override;

  void plan(const SamplerContext& context);

  const char* name_;
  RedistributionSamplerSettings settings_;
  Chains use_;
  RedistributionPlan plan_;
  ExcessLimit limit_;
  AboveLimit above_;
  Redistribution chains_;
  double work_ = 1.0;  // evaluations a sample, on average
};

}  // namespace pssmlt
