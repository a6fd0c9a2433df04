// Between a chain (advance.h) and the render: evaluates the integrator, sends credits to the film.
#pragma once

#include <utility>
#include <vector>

#include "core/metropolis/walker.h"
#include "core/sampler.h"
#include "core/sampling/evaluator.h"

namespace pssmlt {

// A chain between two rounds: its state alone.
struct Chain {
  StoredNumbers numbers;
  std::vector<Splat> splats;
  double value = 0.0;
  PixelCredit credit;
  uint64_t stuck = 0;
};

// What advance() asks of its host.
class ChainHost {
 public:
  ChainHost(SplatSink& sink, Worker& worker, Splats& current, int group)
      : sink_(sink), worker_(worker), current_(current), group_(group) {}
  void restore(const Chain& chain) {
    current_.assign(chain.splats.data(), chain.splats.size());
    current_credit_ = chain.credit;
  }
  void store(Chain& chain) const {
    chain.splats = current_.all();
    chain.credit = current_credit_;
  }

  double evaluate(PrimarySample& u) {
    const bool good = worker_.evaluator.evaluate(u, worker_.splats, worker_.workspace);
    proposed_credit_ = worker_.sample.credit();
    return good ? luminance(worker_.splats) : 0.0;
  }
  void credit_current(double weight) { sink_.add(0, current_, current_credit_, weight, group_); }
  void credit_proposed(double weight) {
    sink_.add(0, worker_.splats, proposed_credit_, weight, group_);
  }
  void credit_large(double weight) {
    sink_.add(1, worker_.splats, proposed_credit_, weight, group_);
  }
  void accept() {
    std::swap(current_, worker_.splats);
    current_credit_ = proposed_credit_;
  }

 private:
  SplatSink& sink_;
  Worker& worker_;
  Splats& current_;
  PixelCredit current_credit_, proposed_credit_;
  int group_;
};

}  // namespace pssmlt
