// Which integrators a sampler may choose from.
#include "core/scene/integrator_choice.h"

#include <gtest/gtest.h>

#include "core/path/path_expression.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

// Sees what it is told to, and returns a value of its own; its scratch is of a type of its own.
template <int number>
class Toy final : public Integrator {
 public:
  Toy(std::string sees, bool fixed, bool for_chains)
      : sees_(std::move(sees)), fixed_(fixed), for_chains_(for_chains) {}
  void prepare(const Scene&) override {}
  void sample(PrimarySample&, Splats& out, Workspace& workspace) const override {
    struct Mine {
      std::array<int, number> value{};
    };
    auto& mine = workspace.scratch<Mine>();
    mine.value.back() = number;
    out.light({0.0, 0.0}, Rgb(static_cast<float>(mine.value.back())), {});
  }
  std::string sees() const override { return sees_; }
  bool splats_light() const override { return number == 1; }
  const PathLimits& limits() const override { return limits_; }
  bool fixed() const override { return fixed_; }
  bool is_for_chains() const override { return for_chains_; }

 private:
  std::string sees_;
  bool fixed_, for_chains_;
  PathLimits limits_;
};

template <int number>
IntegratorChoice::Named toy(const std::string& sees, bool fixed = true, bool for_chains = false) {
  return {"toy" + std::to_string(number), std::make_shared<Toy<number>>(sees, fixed, for_chains)};
}

std::vector<std::string> names(const IntegratorChoice& choice) {
  std::vector<std::string> names;
  for (int i = 0; i < choice.alternatives(); ++i) names.push_back(choice.alternative_name(i));
  return names;
}

// A lamp with an area, in sight.
BuiltScene lamp() {
  test::Job job;
  job.scene = R"(
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Camera "perspective"
WorldBegin
AreaLightSource "diffuse"
Shape "sphere" "float radius" 1
)";
  return test::build_text(job);
}

using Names = std::vector<std::string>;

// What is blind to light that the scene does not have may be chosen all the same.
TEST(IntegratorChoice, LeavesOutWhatMissesLight) {
  const BuiltScene built = lamp();
  IntegratorChoice choice({toy<1>("L(D|S)*E"), toy<2>("L.*E"), toy<3>("(A|I).*E"), toy<4>("P.*E")});
  choice.prepare(*built.scene);
  EXPECT_EQ(names(choice), (Names{"toy1", "toy2", "toy3"}));
  EXPECT_TRUE(choice.splats_light());
}

TEST(IntegratorChoice, KeepsTheOneThatSeesMostWhereNoneSeesAll) {
  const BuiltScene built = lamp();
  IntegratorChoice choice({toy<1>("LS*E"), toy<2>("LD.*E")});
  choice.prepare(*built.scene);
  EXPECT_EQ(names(choice), (Names{"toy2"}));
}

TEST(IntegratorChoice, LeavesOutEstimatesThatChange) {
  const BuiltScene built = lamp();
  IntegratorChoice some({toy<1>("L.*E", false), toy<2>("L.*E")});
  some.prepare(*built.scene);
  EXPECT_EQ(names(some), (Names{"toy2"}));
  EXPECT_TRUE(some.fixed());
  IntegratorChoice only({toy<1>("L.*E", false)});
  only.prepare(*built.scene);
  EXPECT_EQ(names(only), (Names{"toy1"}));
  EXPECT_FALSE(only.fixed());
}

TEST(IntegratorChoice, LeavesOutWhatIsMadeForChains) {
  const BuiltScene built = lamp();
  IntegratorChoice some({toy<1>("L.*E", true, true), toy<2>("L.*E")});
  some.prepare(*built.scene);
  EXPECT_EQ(names(some), (Names{"toy2"}));
  IntegratorChoice only({toy<1>("L.*E", true, true)});
  only.prepare(*built.scene);
  EXPECT_EQ(names(only), (Names{"toy1"}));
}

// Each has a workspace of its own, and keeps it while others are asked.
TEST(IntegratorChoice, SamplesAreThoseOfTheOneChosen) {
  const BuiltScene built = lamp();
  IntegratorChoice choice({toy<1>("L.*E"), toy<2>("L.*E"), toy<3>("L.*E")});
  choice.prepare(*built.scene);
  PrimarySample u;
  Splats out;
  Workspace workspace;
  for (const int i : {0, 2, 1, 2, 0}) {
    choice.choose(i);
    out.clear();
    choice.sample(u, out, workspace);
    ASSERT_EQ(out.all().size(), 1u);
    EXPECT_EQ(out.all()[0].value, Rgb(static_cast<float>(i + 1)));
  }
}

}  // namespace
}  // namespace pssmlt
