// Advances a chain and credits what it visits: current and proposed state both by their expected
// value, the current one's weight gathered and handed on once, when the state changes.
#pragma once

#include <algorithm>
#include <array>

#include "core/metropolis/normalisation.h"
#include "core/metropolis/walker.h"

namespace pssmlt {

// What a visit of a state with target value F is worth. The sum of credits of N mutations, times
// b / (beta N) for the chain's and 1 / N for the large steps' own, is the integral.
//  expected: beta / F. Only the chain's credits exist.
//  kelemen: 1 / (F / beta + large) (Kelemen et al. 2002, section 5.2): large steps are independent
//    uniform samples and combined with the chain by the balance heuristic. Beta is b as the
//    bootstrap found it and never changes; that b moves on does not make the weights wrong, since
//    the chain's credits are scaled by b / beta and those of the large steps by 1.
class CreditRule {
 public:
  static CreditRule expected(double beta) { return {beta, 0.0}; }
  static CreditRule kelemen(double beta, double large) { return {beta, large}; }
  bool credits_large_steps() const { return large_ > 0.0; }
  double visit(double value) const { return 1.0 / (value / beta_ + large_); }
  double beta() const { return beta_; }

 private:
  CreditRule(double beta, double large) : beta_(beta), large_(large) {}
  double beta_, large_;
};

// What happened in many mutations; merged in a fixed order.
struct WalkTally {
  struct Kind {
    uint64_t proposed = 0, accepted = 0;
  };
  std::array<Kind, step_kinds> kinds{};
  MeanTally large_values;      // target's values at large steps: independent samples of b
  uint64_t longest_stuck = 0;  // mutations in one state
  void merge(const WalkTally& other) {
    for (size_t k = 0; k < step_kinds; ++k) {
      kinds[k].proposed += other.kinds[k].proposed;
      kinds[k].accepted += other.kinds[k].accepted;
    }
    large_values.merge(other.large_values);
    longest_stuck = std::max(longest_stuck, other.longest_stuck);
  }
};

// A chain on its way.
struct Walk {
  double pending = 0.0;  // credit of the current state not handed on yet
  uint64_t stuck = 0;    // mutations since it became current
};

// What was decided of the proposal, which is worth so much: its credit, and the change of state.
template <typename Host>
void conclude(Host& host, const Transition& t, double worth, Walk& walk, WalkTally& tally) {
  WalkTally::Kind& kind = tally.kinds[static_cast<size_t>(t.kind)];
  ++kind.proposed;
  if (!t.accepted) {
    if (t.acceptance > 0.0) host.credit_proposed(t.acceptance * worth);
    return;
  }
  ++kind.accepted;
  if (walk.pending > 0.0) host.credit_current(walk.pending);
  walk = {t.acceptance * worth, 0};
  host.accept();
}

// The second proposal of a mutation.
template <typename Host>
void try_again(Walker& walker, PrimarySampleOwner& owner, Host& host, const CreditRule& rule,
               Walk& walk, WalkTally& tally) {
  const double current = walker.value();
  walker.propose_again();
  const double proposed = host.evaluate(owner.sample());
  const double worth = proposed > 0.0 ? rule.visit(proposed) : 0.0;
  const Transition t = walker.decide_again(proposed);
  walk.pending += (1.0 - t.acceptance) * rule.visit(current);
  conclude(host, t, worth, walk, tally);
}

// Runs `count` mutations of the chain in `walker`; `stuck` counts those since its state changed.
// Host has
//   double evaluate(PrimarySample&)         target at the proposal, >= 0, finite; remembers what it
//                                           measured there as "proposed"
//   void credit_current(double weight)      adds weight * what the current state measured
//   void credit_proposed(double weight)     same for the proposal
//   void credit_large(double weight)        same for the proposal, to the large steps' sum
//   void accept()                           the proposal becomes the current state
// Where a rejected step leads to a second try, its outcome alone decides what the current state
// gets: in the mean over rejections that is its part.
template <typename Host>
void advance(Walker& walker, PrimarySampleOwner& owner, Host& host, const CreditRule& rule,
             uint64_t count, uint64_t& stuck, WalkTally& tally) {
  Walk walk{0.0, stuck};
  for (uint64_t m = 0; m < count; ++m) {
    const double current = walker.value();
    const bool large = walker.propose().kind == StepKind::large;
    const double proposed = host.evaluate(owner.sample());
    const double worth = proposed > 0.0 ? rule.visit(proposed) : 0.0;
    if (large) tally.large_values.add(proposed);
    if (large && worth > 0.0 && rule.credits_large_steps()) host.credit_large(worth);
    const Transition t = walker.decide(proposed);
    ++walk.stuck;
    tally.longest_stuck = std::max(tally.longest_stuck, walk.stuck);
    if (!walker.gives_second_tries(t.kind)) {
      walk.pending += (1.0 - t.acceptance) * rule.visit(current);
    }
    conclude(host, t, worth, walk, tally);
    if (walker.tries_again()) try_again(walker, owner, host, rule, walk, tally);
  }
  if (walk.pending > 0.0) host.credit_current(walk.pending);
  stuck = walk.stuck;
}

}  // namespace pssmlt
