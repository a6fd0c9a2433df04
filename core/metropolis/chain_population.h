// The Markov chains of one render: bootstrap, seeds, mutations, normalisation. What samplers with
// chains in primary sample space have in common, whatever their chains follow.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/metropolis/advance.h"
#include "core/metropolis/chain_host.h"
#include "core/metropolis/walk_parameters.h"
#include "core/sampler.h"

namespace pssmlt {

// Three in each group: steps "ensemble" use two others of the same.
inline constexpr int least_chains_for_ensembles = 3 * group_count;

struct PopulationSettings {
  StepMix mix;
  KernelChoice kernels;
  int chains = 0;  // 0: by the picture's size
  int bootstrap_samples = 100000;
  bool refine_b = true, kelemen_weights = false;
  bool second_tries = false, tune_steps = false;
  double ensemble_scale = 0.5;  // WalkSettings::ensemble_scale
  uint64_t seed = 0;
};
// "chains", "bootstrapsamples" with this default (0 leaves the number to the sampler), "b",
// "weights", "delayedrejection", "tunesteps", "ensembleprobability", "ensemblescale" and those of
// steps and kernels.
PopulationSettings read_population(Parameters& parameters, int bootstrap_samples);

// Sampler's functions of the same names do what is said there. The chains' credits go to the plane
// `plane`, those of Kelemen-weighted large steps to the one after it.
class ChainPopulation {
 public:
  // name: of the sampler, for messages; static.
  ChainPopulation(const char* name, const PopulationSettings& settings)
      : name_(name), settings_(settings) {}

  // Number of chains, length of a round: functions of the settings, the size and the picture. Then
  // the bootstrap; chains start where it found something. Keeps the target.
  void start(const SamplerContext& context, const ChainTarget& target) {
    start(context, target, Size());
  }
  // For those who know better than the settings' defaults.
  struct Size {
    double mutations = 0.0;  // of a round, about; 0: by the picture's size
    int candidates = 0;      // of the bootstrap; 0: the settings'
  };
  void start(const SamplerContext& context, const ChainTarget& target, const Size& size);
  // No candidate is worth anything: there are no chains.
  bool empty() const { return chains_.empty(); }
  int units() const { return chain_count_ / chains_a_unit; }
  // Mutations of a round.
  double mutations() const { return double(chain_count_) * steps_; }
  void run(int64_t round, int unit, int plane, SplatSink& sink, Worker& worker);
  // Of the chains' plane; the factor of Kelemen's large steps does not know b.
  double scale(int64_t rounds) const;
  double large_scale(int64_t rounds) const;
  double scale_relative_variance() const;

  void save(Archive& archive) const;
  void load(Archive& archive);
  bool replay(const std::string& key, Worker& worker) const;
  // Of few candidates, and of settings that hide errors.
  std::vector<std::string> warnings() const;
  // "" if enough candidates contributed for b and its error to be known.
  std::string unknown_error() const;
  std::string remedy() const;
  void report(nlohmann::json& statistics) const;

 private:
  static constexpr int chains_a_unit = 8;
  void plan(const RasterFrame& frame, double mutations_a_round);
  void bootstrap(const SamplerContext& context);
  void start_chains(const SamplerContext& context);
  int group(int chain) const;
  void start_chain(int chain, uint32_t candidate, Worker& worker);
  // Of the same unit and group: chains of other groups must stay independent of it.
  using Mates = std::array<const StoredNumbers*, chains_a_unit>;
  std::span<const StoredNumbers* const> mates(int chain, Mates& room) const;
  WalkTally total() const;
  MeanTally normalisation() const;  // b with its error

  const char* name_;
  PopulationSettings settings_;
  const ChainTarget* target_ = nullptr;
  WalkSettings walk_;
  StepFactors factors_ = as_chosen;  // of the kernels' scales
  std::optional<StepChooser> chooser_;
  double pixels_ = 1.0;
  int chain_count_ = 0;
  int steps_ = 1;                   // mutations of each chain in a round
  std::vector<double> candidates_;  // target's values, until the chains have started
  MeanTally bootstrap_;
  uint64_t contributing_ = 0;  // candidates worth something
  std::vector<Chain> chains_;
  std::vector<WalkTally> tallies_;  // by unit
};

}  // namespace pssmlt
