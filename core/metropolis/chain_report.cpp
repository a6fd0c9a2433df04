// What a population of chains says of itself.
#include <nlohmann/json.hpp>

#include "core/metropolis/chain_population.h"
#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

// Signs of what is wrong where chains get on too slowly: rates of small steps, and a long stay.
constexpr double least_acceptance = 0.05, most_acceptance = 0.95;
constexpr uint64_t stuck_mutations = 1000;

}  // namespace

std::vector<std::string> ChainPopulation::warnings() const {
  std::vector<std::string> result;
  const std::string sampler = std::string("sampler \"") + name_ + "\": ";
  if (empty()) {
    result.push_back(sampler + "none of " + std::to_string(settings_.bootstrap_samples) +
                     " bootstrap samples found any light; the picture is black");
  } else if (contributing_ < least_bootstrap) {
    result.push_back(sampler + unknown_error() +
                     ": brightness and error are unknown; raise \"bootstrapsamples\", or choose an "
                     "integrator that finds the light more often");
  }
  if (settings_.mix.large <= 0.0) {
    result.push_back(sampler +
                     "\"largestepprobability\" is 0: no chain gets where small steps do not "
                     "lead, b is the bootstrap's alone, and neither shows in the estimated error");
  }
  if (settings_.mix.ensemble > 0.0 && chain_count_ < least_chains_for_ensembles) {
    result.push_back(sampler + "only " + std::to_string(chain_count_) +
                     " chains: no group has three, and steps by other chains' states lead nowhere");
  }
  return result;
}

std::string ChainPopulation::unknown_error() const {
  if (contributing_ >= least_bootstrap) return "";
  return "only " + std::to_string(contributing_) + " of " +
         std::to_string(settings_.bootstrap_samples) +
         " bootstrap samples found light, fewer than " + std::to_string(least_bootstrap);
}

// By the commonest causes in the order of how sure their signs are.
std::string ChainPopulation::remedy() const {
  const WalkTally sum = total();
  const WalkTally::Kind& large = sum.kinds[static_cast<size_t>(StepKind::large)];
  WalkTally::Kind small;
  for (const WalkTally::Kind& k : sum.kinds) {
    small.proposed += k.proposed;
    small.accepted += k.accepted;
  }
  small.proposed -= large.proposed;
  small.accepted -= large.accepted;
  const double rate =
      small.proposed > 0 ? static_cast<double>(small.accepted) / static_cast<double>(small.proposed)
                         : 0.5;
  if (settings_.mix.large <= 0.0) return "\"largestepprobability\", which is 0";
  if (rate < least_acceptance) {
    return "smaller steps (\"sigma\" with the kernel \"gaussian\"): they are hardly ever accepted";
  }
  if (rate > most_acceptance) {
    return "larger steps (\"sigma\" with the kernel \"gaussian\"): nearly all are accepted, so "
           "that "
           "chains do not get far";
  }
  if (sum.longest_stuck >= stuck_mutations) {
    return "more \"chains\" and \"bootstrapsamples\": a chain stayed in one state for " +
           std::to_string(sum.longest_stuck) + " mutations";
  }
  return "a larger \"largestepprobability\", or more \"chains\"";
}

void ChainPopulation::report(nlohmann::json& statistics) const {
  const WalkTally sum = total();
  const MeanTally b = normalisation();
  nlohmann::json& acceptance = statistics["acceptance"];
  acceptance = nlohmann::json::object();
  uint64_t mutations = 0, accepted = 0;
  for (size_t k = 0; k < step_kinds; ++k) {
    const WalkTally::Kind& kind = sum.kinds[k];
    mutations += kind.proposed;
    accepted += kind.accepted;
    if (kind.proposed == 0) continue;
    acceptance[std::string(to_string(static_cast<StepKind>(k)))] = {
        {"mutations", kind.proposed},
        {"rate", static_cast<double>(kind.accepted) / static_cast<double>(kind.proposed)}};
    if (settings_.tune_steps) {
      acceptance[std::string(to_string(static_cast<StepKind>(k)))]["step_scale"] = factors_[k];
    }
  }
  statistics["acceptance_rate"] =
      mutations > 0 ? static_cast<double>(accepted) / static_cast<double>(mutations) : 0.0;
  statistics["mutations"] = mutations;
  statistics["chains"] = chain_count_;
  statistics["b"] = b.mean();
  statistics["b_standard_error"] = b.standard_error();
  statistics["b_samples"] = b.count;
  statistics["longest_stuck"] = sum.longest_stuck;
  statistics["bootstrap_samples"] = bootstrap_.count;
  statistics["bootstrap_contributing"] = contributing_;
}

}  // namespace pssmlt
