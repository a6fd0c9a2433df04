// Group 10: chains, on targets in closed form over many seeds and in scenes.
#include <cmath>

#include "app/stress/catalogue.h"
#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"

namespace pssmlt::stress {
namespace {

Case targets(const std::string& name, const std::string& about,
             const std::vector<std::pair<std::string, ChainTarget>>& values) {
  Case c{.group = 10, .name = name, .about = about, .over = Over::samplers};
  for (const auto& [value, target] : values) {
    c.points.push_back({value, {}, Probe{[target = target](const ProbeContext& context) {
                          return chains_on_target(context, target);
                        }}});
  }
  return c;
}

// Enough bootstrap samples that some five find the light: sixty in all renders of the rarest.
int bootstrap_for(double share) { return static_cast<int>(std::max(4096.0, 5.0 / share)); }

void add_shapes(Cases& cases) {
  std::vector<std::pair<std::string, ChainTarget>> spikes, islands, gaps;
  for (const double size : {1e-6, 1e-4, 1e-2}) {
    // The rarest one has few seeds: each needs five million samples.
    spikes.emplace_back(fmt::format("{}", size), ChainTarget{.kind = ChainTarget::spike,
                                                             .size = static_cast<float>(size),
                                                             .seeds = size < 1e-5 ? 12 : 100,
                                                             .bootstrap = bootstrap_for(size)});
  }
  for (const double size : {1e-3, 1e-2, 1e-1}) {
    islands.emplace_back(fmt::format("{}", size),
                         ChainTarget{.kind = ChainTarget::islands,
                                     .size = static_cast<float>(size),
                                     .seeds = size < 2e-3 ? 12 : 100,
                                     .bootstrap = bootstrap_for(size * size)});
  }
  for (const double size : {1e-6, 1e-4, 1e-2, 1e-1}) {
    gaps.emplace_back(fmt::format("{}", size), ChainTarget{.kind = ChainTarget::gap,
                                                           .size = static_cast<float>(size),
                                                           .seeds = size < 1e-5 ? 12 : 100,
                                                           .bootstrap = bootstrap_for(size)});
  }
  cases.push_back(targets("spike", "part of the space that holds half of the energy", spikes));
  cases.push_back(targets("islands", "size of eight islands in nothing", islands));
  cases.push_back(targets("gap", "width of a gap that lets light through", gaps));
  cases.push_back(targets("constant", "a target that is the same everywhere",
                          {{"-", ChainTarget{.kind = ChainTarget::constant}}}));
}

void add_settings(Cases& cases) {
  const auto smooth = [](auto... set) {
    ChainTarget t{.kind = ChainTarget::smooth};
    (set(t), ...);
    return t;
  };
  std::vector<std::pair<std::string, ChainTarget>> sigmas, large, chains, mutations;
  for (const double sigma : {1e-6, 1.0, 1e-3, .1}) {
    sigmas.emplace_back(fmt::format("{}", sigma), smooth([=](ChainTarget& t) { t.sigma = sigma; }));
  }
  for (const double p : {0.0, 1.0, .3}) {
    large.emplace_back(fmt::format("{}", p), smooth([=](ChainTarget& t) { t.large = p; }));
  }
  for (const int count : {100000, 1, 1024}) {
    chains.emplace_back(std::to_string(count), smooth([=](ChainTarget& t) {
                          t.chains = count;
                          if (count > 10000) t.seeds = 20;
                        }));
  }
  for (const double count : {1.0, 1e6, 100.0}) {
    mutations.emplace_back(fmt::format("{}", count), smooth([=](ChainTarget& t) {
                             t.mutations = count;
                             if (count > 1e5) t.seeds = 8;
                           }));
  }
  cases.push_back(targets("sigma", "width of small steps", sigmas));
  cases.push_back(targets("large-steps", "probability of large steps, b kept", large));
  cases.push_back(targets("chains", "number of chains", chains));
  cases.push_back(targets("mutations", "mutations a pixel", mutations));
}

}  // namespace

void add_metropolis_cases(Cases& cases) {
  add_shapes(cases);
  add_settings(cases);
  Case bias{.group = 10,
            .name = "refined-b",
            .about = "bias of b refined by large steps: of the order of 1 / bootstrapsamples",
            .over = Over::samplers};
  bias.points.push_back({"64..1024", {}, Probe{bias_of_refined_b}});
  cases.push_back(std::move(bias));
  Case none{.group = 10,
            .name = "no-large-steps",
            .about = "probability 0 of large steps in a scene: a warning, and how chains differ",
            .over = Over::samplers};
  none.points.push_back({"0", {}, Probe{no_large_steps}});
  cases.push_back(std::move(none));
}

}  // namespace pssmlt::stress
