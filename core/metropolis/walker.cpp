#include "core/metropolis/walker.h"

#include <algorithm>

namespace pssmlt {
namespace {

// The four numbers of a block, by its address; null if it is not held.
const uint32_t* find_block(const StoredNumbers& numbers, uint32_t what) {
  for (size_t at = 0; at + words_a_block <= numbers.size(); at += words_a_block) {
    if (numbers[at] == what) return &numbers[at + 1];
  }
  return nullptr;
}

}  // namespace

void store_numbers(const PrimarySampleOwner& owner, StoredNumbers& numbers) {
  numbers.clear();
  for (uint32_t s = 0; s < stream_count; ++s) {
    const StreamNumbers& stream = owner.current(static_cast<Stream>(s));
    for (uint32_t i = 0; i < stream.end(); ++i) {
      const NumberBlock* block = stream.find(i);
      if (block == nullptr) continue;
      numbers.push_back(i << 2 | s);
      numbers.insert(numbers.end(), block->begin(), block->end());
    }
  }
}

void restore_numbers(const StoredNumbers& numbers, bool raster, NumberSource& source,
                     PrimarySampleOwner& owner) {
  owner.begin(source);
  for (size_t at = 0; at + words_a_block <= numbers.size(); at += words_a_block) {
    const auto stream = static_cast<Stream>(numbers[at] & 3u);
    NumberBlock& block = owner.restore(stream).add(numbers[at] >> 2);
    for (size_t i = 0; i < 4; ++i) block[i] = numbers[at + 1 + i];
  }
  if (raster) (void)owner.sample().raster();
}

void Walker::load(uint32_t chain, uint64_t mutation, const StoredNumbers& numbers, bool raster,
                  double value) {
  chain_ = chain;
  mutation_ = mutation;
  value_ = value;
  restore_numbers(numbers, raster, *this, owner_);
}

RandomBlock Walker::random(RandomUse use, uint32_t what) const {
  // 24 bits of the mutation's number beside the use: 2^56 mutations a chain.
  const auto high = static_cast<uint32_t>(mutation_ >> 32) << 8;
  return philox(settings_.seed, {what, static_cast<uint32_t>(mutation_), chain_,
                                 static_cast<uint32_t>(use) | high});
}

const Step& Walker::propose() {
  const RandomBlock bits = random(RandomUse::decide, 0);
  return begin(chooser_.choose(bits[0], bits[1]), bits);
}

const Step& Walker::propose_again() {
  const RandomBlock bits = random(RandomUse::decide_again, 0);
  return begin(chooser_.choose_small(bits[0], bits[1]), bits);
}

const Step& Walker::begin(const Step& step, const RandomBlock& bits) {
  step_ = step;
  accept_bits_ = bits[2];
  accept_more_ = bits[3];
  if (step_.kind == StepKind::ensemble) choose_mates();
  owner_.begin_proposal(*this, step_.streams);
  return step_;
}

void Walker::fill(Stream stream, uint32_t index, NumberBlock& block) {
  const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
  const bool moves = step_.kind != StepKind::large && step_.changes(stream);
  const NumberBlock* from = moves ? owner_.current(stream).find(index) : nullptr;
  if (from == nullptr) {
    block = random(again_ ? RandomUse::fresh_again : RandomUse::fresh, what);
    return;
  }
  if (index < step_.first || index >= step_.end) {
    block = *from;
    return;
  }
  if (step_.kind == StepKind::ensemble) {
    block = moved_by_mates(*from, what);
    return;
  }
  const bool film = stream == Stream::camera && index == 0;
  const RandomUse use = again_ ? RandomUse::mutate_again : RandomUse::mutate;
  move(*from, film, random(use, what), block);
}

void Walker::move(const NumberBlock& from, bool film, const RandomBlock& bits,
                  NumberBlock& block) const {
  block = from;
  if (step_.kind != StepKind::film) {
    block = settings_.kernels[static_cast<size_t>(step_.kind)].step(from, bits);
  }
  if (!film) return;
  block[0] = settings_.film_x.step(from[0], bits[0]);
  block[1] = settings_.film_y.step(from[1], bits[1]);
}

// Any two, in any order, so that a step and its reverse are equally probable. One in ten adds the
// whole difference, by which chains on two of the target's islands change places (ter Braak 2006).
void Walker::choose_mates() {
  plus_ = minus_ = nullptr;
  if (mates_.size() < 2) return;
  const RandomBlock bits = random(again_ ? RandomUse::mates_again : RandomUse::mates, 0);
  const auto count = static_cast<uint64_t>(mates_.size());
  const uint64_t plus = bits[0] * count >> 32;
  const uint64_t other = bits[1] * (count - 1) >> 32;
  plus_ = mates_[plus];
  minus_ = mates_[other < plus ? other : other + 1];
  scale_ = bits[2] < 0x1999999Au ? 1.0 : settings_.ensemble_scale;
}

// Numbers that one of the two does not hold stay.
NumberBlock Walker::moved_by_mates(const NumberBlock& from, uint32_t what) const {
  NumberBlock block = from;
  if (plus_ == nullptr) return block;
  const uint32_t* const plus = find_block(*plus_, what);
  const uint32_t* const minus = find_block(*minus_, what);
  if (plus == nullptr || minus == nullptr) return block;
  for (size_t i = 0; i < 4; ++i) {
    // On the torus the shorter way round; rounded alike in both directions.
    const auto apart = static_cast<int32_t>(plus[i] - minus[i]);
    block[i] += static_cast<uint32_t>(static_cast<int64_t>(scale_ * apart));
  }
  return block;
}

// Accepts with this probability.
Transition Walker::settle(double acceptance, double value) {
  const double u = static_cast<double>(uint64_t{accept_bits_} << 32 | accept_more_) * 0x1p-64;
  const Transition t{step_.kind, acceptance, u < acceptance};
  if (t.accepted) {
    owner_.accept();
    value_ = value;
  } else {
    owner_.reject();
  }
  return t;
}

Transition Walker::decide(double proposed_value) {
  const double acceptance = proposed_value > 0.0 ? std::min(1.0, proposed_value / value_) : 0.0;
  const Transition t = settle(acceptance, proposed_value);
  again_ = gives_second_tries(t.kind) && !t.accepted;
  rejected_ = proposed_value;
  if (!again_) ++mutation_;
  return t;
}

Transition Walker::decide_again(double proposed_value) {
  const double room = std::max(0.0, proposed_value - rejected_);
  const Transition t = settle(std::min(1.0, room / (value_ - rejected_)), proposed_value);
  again_ = false;
  ++mutation_;
  return t;
}

}  // namespace pssmlt
