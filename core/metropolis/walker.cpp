#include "core/metropolis/walker.h"

namespace pssmlt {

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
  step_ = chooser_.choose(bits[0], bits[1]);
  accept_bits_ = bits[2];
  accept_more_ = bits[3];
  owner_.begin_proposal(*this, step_.streams);
  return step_;
}

void Walker::fill(Stream stream, uint32_t index, NumberBlock& block) {
  const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
  const bool moves = step_.kind != StepKind::large && step_.changes(stream);
  const NumberBlock* from = moves ? owner_.current(stream).find(index) : nullptr;
  if (from == nullptr) {
    block = random(RandomUse::fresh, what);
    return;
  }
  if (index < step_.first || index >= step_.end) {
    block = *from;
    return;
  }
  const bool film = stream == Stream::camera && index == 0;
  move(*from, film, step_.kind != StepKind::film, random(RandomUse::mutate, what), block);
}

void Walker::move(const NumberBlock& from, bool film, bool rest, const RandomBlock& bits,
                  NumberBlock& block) const {
  block = rest ? settings_.kernel.step(from, bits) : from;
  if (!film) return;
  block[0] = settings_.film_x.step(from[0], bits[0]);
  block[1] = settings_.film_y.step(from[1], bits[1]);
}

Transition Walker::decide(double proposed_value) {
  Transition t{step_.kind};
  if (proposed_value > 0.0) t.acceptance = std::min(1.0, proposed_value / value_);
  const double u = static_cast<double>(uint64_t{accept_bits_} << 32 | accept_more_) * 0x1p-64;
  t.accepted = u < t.acceptance;
  if (t.accepted) {
    owner_.accept();
    value_ = proposed_value;
  } else {
    owner_.reject();
  }
  ++mutation_;
  return t;
}

}  // namespace pssmlt
