// Between a chain (advance.h) and the render: evaluates the integrator, sends credits to the film.
#pragma once

#include <utility>
#include <vector>

#include "core/metropolis/chain_target.h"
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
  // Credits go to `plane` of the sampler, those of large steps to the next.
  ChainHost(const ChainTarget& target, SplatSink& sink, int plane, Worker& worker, Splats& current,
            int group)
      : target_(target),
        sink_(sink),
        plane_(plane),
        worker_(worker),
        current_(current),
        group_(group) {}
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
    return good ? target_.evaluate(worker_.splats, proposed_credit_) : 0.0;
  }
  void credit_current(double weight) {
    sink_.add(plane_, current_, current_credit_, weight, group_);
  }
  void credit_proposed(double weight) {
    sink_.add(plane_, worker_.splats, proposed_credit_, weight, group_);
  }
  void credit_large(double weight) {
    sink_.add(plane_ + 1, worker_.splats, proposed_credit_, weight, group_);
  }
  void accept() {
    std::swap(current_, worker_.splats);
    current_credit_ = proposed_credit_;
  }

 private:
  const ChainTarget& target_;
  SplatSink& sink_;
  int plane_;
  Worker& worker_;
  Splats& current_;
  PixelCredit current_credit_, proposed_credit_;
  int group_;
};

}  // namespace pssmlt
