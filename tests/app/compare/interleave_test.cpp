// Turns by a clock that the racers themselves move on.
#include "app/compare/interleave.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pssmlt::compare {
namespace {

class FakeRacer final : public Racer {
 public:
  FakeRacer(char name, double first_round, double round, std::string& log)
      : name_(name), first_round_(first_round), round_(round), log_(log) {}
  double elapsed() const override { return elapsed_; }
  void round() override {
    elapsed_ += elapsed_ == 0.0 ? first_round_ : round_;
    log_ += name_;
  }

 private:
  char name_;
  double first_round_, round_;
  std::string& log_;
  double elapsed_ = 0.0;
};

void race(const Slices& slices, std::vector<FakeRacer>& racers, int stop_after = 1 << 30) {
  std::vector<Racer*> all;
  for (FakeRacer& r : racers) all.push_back(&r);
  int rounds = 0;
  (void)interleave(
      all, slices, [&] { return ++rounds >= stop_after; }, [] {});
}

TEST(Interleave, TakesTurns) {
  std::string log;
  std::vector<FakeRacer> racers = {
      {'A', 0.25, 0.25, log}, {'B', 0.25, 0.25, log}, {'C', 0.25, 0.25, log}};
  race({1.0, 0.25}, racers);
  EXPECT_EQ(log, "ABCABCABCABC");
}

TEST(Interleave, SeveralRoundsFitIntoATurn) {
  std::string log;
  std::vector<FakeRacer> racers = {{'A', 0.5, 0.5, log}, {'B', 0.125, 0.125, log}};
  race({1.0, 0.5}, racers);
  EXPECT_EQ(log, "ABBBBABBBB");
}

// The first round of B bootstraps for three slices: B is skipped until A has caught up.
TEST(Interleave, LongRoundsSkipTurns) {
  std::string log;
  std::vector<FakeRacer> racers = {{'A', 0.25, 0.25, log}, {'B', 0.75, 0.25, log}};
  race({1.0, 0.25}, racers);
  EXPECT_EQ(log, "ABAAAB");
  EXPECT_EQ(racers[0].elapsed(), 1.0);
  EXPECT_EQ(racers[1].elapsed(), 1.0);
}

// A technique whose round is longer than the budget has that round and no other.
TEST(Interleave, EveryoneHasARound) {
  std::string log;
  std::vector<FakeRacer> racers = {{'A', 0.5, 0.5, log}, {'B', 30.0, 1.0, log}};
  race({1.0, 0.5}, racers);
  EXPECT_EQ(log, "ABA");
}

TEST(Interleave, StopsAfterARound) {
  std::string log;
  std::vector<FakeRacer> racers = {{'A', 0.25, 0.25, log}, {'B', 0.25, 0.25, log}};
  race({1.0, 0.25}, racers, 3);
  EXPECT_EQ(log, "ABA");
}

TEST(Interleave, CallsBackAfterEverySlice) {
  std::string log;
  FakeRacer a('A', 0.25, 0.25, log), b('B', 0.25, 0.25, log);
  Racer* const all[] = {&a, &b};
  EXPECT_TRUE(interleave(
      all, {0.5, 0.25}, [] { return false; }, [&] { log += '.'; }));
  EXPECT_EQ(log, "AB.AB.");
}

TEST(Interleave, OrderRotatesFromRunToRun) {
  const auto in_run = [](int run) {
    std::vector<int> order;
    for (int i = 0; i < 3; ++i) order.push_back(rotated(i, run, 3));
    return order;
  };
  EXPECT_EQ(in_run(0), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(in_run(1), (std::vector<int>{1, 2, 0}));
  EXPECT_EQ(in_run(4), (std::vector<int>{1, 2, 0}));
}

}  // namespace
}  // namespace pssmlt::compare
