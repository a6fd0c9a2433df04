// Every integrator under every kind of sampler shows the same picture, on the classes of paths that
// it sees: the pictures of eleven scenes are compared by blocks of 16 x 16 pixels with those of the
// integrator that sees most, under the default sampler.
//
// False alarms: below 10^-6 for each test. Power: 0.99 against an error of 2 % that all blocks
// have, and of 20 % in one block alone, computed from the errors measured and asserted.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "core/path/path_expression.h"
#include "core/scene/scene.h"
#include "tests/correctness/classes.h"
#include "tests/correctness/scenes.h"
#include "tests/support/agreement.h"

namespace pssmlt::test {
namespace {

constexpr int edge = 16;     // of a block [pixels]
constexpr int renders = 48;  // of each technique, at least
constexpr Demand demand{2.5e-7, .2, .02};
constexpr Precision reference_goal{.01, .0012};

struct Case {
  AgreementScene scene;
  std::string integrator;
  size_t scene_number = 0, turn = 0;  // which of the samplers with chains
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene.name << " by " << c.integrator; }

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto scenes = agreement_scenes();
  const auto names = integrators();
  for (size_t s = 0; s < scenes.size(); ++s) {
    for (size_t i = 0; i < names.size(); ++i) {
      // Their samples are noisy: every second scene takes as long as all do with others.
      if (s % 2 == 1 && is_for_chains(names[i])) continue;
      all.push_back({scenes[s], names[i], s, s / 2 + i});
    }
  }
  return all;
}

// The default one, but for integrators that are made for chains, and one with chains: pssmlt in
// every second scene, the others in turn.
std::vector<std::string> samplers_of(const Case& c) {
  const std::string usual = "pssmlt";
  std::vector<std::string> others;
  std::ranges::copy_if(samplers(), std::back_inserter(others),
                       [&](const std::string& s) { return is_chain(s) && s != usual; });
  if (others.empty()) others = {usual};
  std::vector<std::string> some;
  if (!is_for_chains(c.integrator)) some.push_back(default_plugins().sampler);
  some.push_back(c.scene_number % 2 == 0 ? usual : others[c.turn % others.size()]);
  return some;
}

class Agreement : public testing::TestWithParam<Case> {};

TEST_P(Agreement, WithTheIntegratorThatSeesMost) {
  const Case& c = GetParam();
  const std::string reference = sees_most();
  const std::string sampler = default_plugins().sampler;
  const std::string classes = both(sees(c.integrator), sees(reference));
  Job job{.scene = c.scene.text, .integrator = reference, .sampler = sampler};
  job.set = {"integrator.paths=" + classes};
  ASSERT_FALSE(unseen(build_text(job), classes)) << "nothing to compare";
  const Blocks truth = render_to_precision(job, renders, edge, reference_goal, 512);
  job.integrator = c.integrator;
  for (const std::string& other : samplers_of(c)) {
    if (other == sampler && c.integrator == reference) continue;
    job.sampler = other;
    job.spp = is_chain(other) ? 32 : 16;
    const Blocks blocks =
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 2048);
    expect_agreement(blocks, truth, demand,
                     c.scene.name + std::string(": ") + c.integrator + " under " + other);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Agreement, testing::ValuesIn(cases()), [](const auto& test) {
  return std::string(test.param.scene.name) + "_" + test.param.integrator;
});

}  // namespace
}  // namespace pssmlt::test
