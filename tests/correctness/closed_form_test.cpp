// Every integrator renders the pictures that are known in closed form, wherever its mask says that
// it sees all the light there is: under the default sampler, and under half of the others (a sixth
// for integrators that are made for chains), which take turns over pictures and integrators.
//
// False alarms: below 10^-6 for each test. Power: 0.99 against an error of 2 % of the whole and 10
// % of a quadrant, computed from the errors measured and asserted. The half per cent that
// conserving materials are held to is asserted wherever that leaves the false alarms where they
// are, which `precise` sees to for the default sampler.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/correctness/classes.h"
#include "tests/correctness/closed_forms.h"
#include "tests/support/agreement.h"

namespace pssmlt::test {
namespace {

constexpr int renders = 64;
constexpr double false_alarm = 2e-7;  // of the pictures of one sampler
constexpr double rounding = 2e-4;     // relative; floats, and colours that are given as decimals

struct Case {
  ClosedForm form;
  std::string integrator;
  size_t turn = 0;  // which of the samplers
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.form.name << " by " << c.integrator; }

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto forms = closed_forms();
  const auto names = integrators();
  for (size_t f = 0; f < forms.size(); ++f) {
    for (size_t i = 0; i < names.size(); ++i) all.push_back({forms[f], names[i], f + i});
  }
  return all;
}

std::vector<std::string> samplers_of(const Case& c) {
  std::vector<std::string> some = {default_plugins().sampler};
  const size_t turns = is_for_chains(c.integrator) ? 6 : 2;  // noisy by itself
  size_t other = 0;
  for (const std::string& name : samplers()) {
    if (name != some.front() && (c.turn + other++) % turns == 0) some.push_back(name);
  }
  return some;
}

// Is every class of paths that brings light into the picture seen?
bool sees_all(const Case& c) {
  const BuiltScene built = build_text({.scene = c.form.scene, .integrator = c.integrator});
  return !unseen_class(built.layers.front().integrator->sees(), c.form.classes,
                       built.scene->features(), c.form.max_depth);
}

// The parts of the picture, and last the whole, whose errors are found as stated above.
void expect_values(const Blocks& blocks, const ClosedForm& form, const std::string& what) {
  const auto parts = static_cast<double>(form.values.size());
  std::vector<double> expected = form.values;
  expected.push_back(std::accumulate(expected.begin(), expected.end(), 0.0) / parts);
  const double limit = student_limit(false_alarm / (parts + 1.0), renders - 1);
  for (size_t i = 0; i < expected.size(); ++i) {
    const Estimate& e = blocks.estimates[i];
    const double difference = std::abs(e.mean - expected[i]);
    EXPECT_LE(difference, std::max(limit * e.error(), rounding * expected[i]))
        << what << ", part " << i
        << fmt::format(": {:.6g} +- {:.2g} is not {:.6g}", e.mean, e.error(), expected[i]);
    const double found = i + 1 < expected.size() && parts > 1.0 ? .1 : .02;
    EXPECT_LE((limit + 2.3263) * e.error(), found * expected[i]) << what << ": too noisy";
    // Where chance alone does not lead that far.
    if (form.half_percent && limit * e.error() <= .005 * expected[i]) {
      EXPECT_LE(difference, .005 * expected[i]) << what;
    }
  }
}

class ClosedForms : public testing::TestWithParam<Case> {};

TEST_P(ClosedForms, UnderSamplersInTurn) {
  const Case& c = GetParam();
  if (!sees_all(c)) GTEST_SKIP() << c.integrator << " does not see " << c.form.classes;
  const DefaultPlugins usual = default_plugins();
  const bool cheap = c.integrator == usual.integrator || c.integrator == sees_most();
  if (c.form.costly && !cheap) GTEST_SKIP() << c.form.name << " would take minutes";
  for (const std::string& sampler : samplers_of(c)) {
    const bool precise = c.form.half_percent && cheap && sampler == usual.sampler;
    const double goal = precise ? .0008 : .0023;
    Job job{.scene = c.form.scene, .integrator = c.integrator, .sampler = sampler};
    job.set = {"integrator.paths=" + c.form.classes};
    // Of 64 pixels.
    if (has_parameter("sampler", sampler, "pilotsamples")) {
      job.set.emplace_back("sampler.pilotsamples=2048");
    }
    job.spp = 64;
    const int edge = c.form.values.size() == 1 ? 8 : 4;
    const Blocks blocks = render_to_precision(job, renders, edge, {4.0 * goal, goal}, 4096);
    expect_values(blocks, c.form, c.form.name + ": " + c.integrator + " under " + sampler);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ClosedForms, testing::ValuesIn(cases()), [](const auto& test) {
  return test.param.form.name + "_" + test.param.integrator;
});

TEST(ClosedForms, FourFifthsOfThePairsRun) {
  const std::vector<Case> all = cases();
  const auto run = static_cast<size_t>(std::count_if(all.begin(), all.end(), sees_all));
  EXPECT_GE(static_cast<double>(run), .8 * static_cast<double>(all.size()));
}

TEST(ClosedForms, SingleScatteringGainsNoEnergy) {
  for (const double alpha : {.1, .3, .5, 1.0}) {
    for (const double cosine : {.2, .5, 1.0}) {
      const double albedo = ggx_albedo(alpha, cosine);
      EXPECT_GT(albedo, .3);
      EXPECT_LE(albedo, 1.0 + 1e-3);
    }
  }
}

}  // namespace
}  // namespace pssmlt::test
