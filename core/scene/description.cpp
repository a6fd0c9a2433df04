#include "core/scene/description.h"

#include <bit>
#include <cstring>

namespace pssmlt {
namespace {

// Odd constants with about half their bits set: pi and the golden ratio.
constexpr uint64_t factor_a = 0x9e3779b97f4a7c15u, factor_b = 0x3243f6a8885a308du;

void mix(std::array<uint64_t, 2>& state, uint64_t word) {
  state[0] = std::rotl((state[0] ^ word) * factor_a, 29);
  state[1] = std::rotl((state[1] + word) * factor_b, 31) ^ state[0];
}

}  // namespace

TransformStep::~TransformStep() {
  std::shared_ptr<const TransformStep> next = std::move(before);
  while (next && next.use_count() == 1) {
    std::shared_ptr<const TransformStep> after = std::move(next->before);
    next = std::move(after);
  }
}

void hash_text(std::array<uint64_t, 2>& state, std::string_view text) {
  mix(state, text.size());
  size_t i = 0;
  for (; i + 8 <= text.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, text.data() + i, 8);
    mix(state, word);
  }
  uint64_t rest = 0;
  for (size_t k = 0; i + k < text.size(); ++k)
    rest |= uint64_t{static_cast<unsigned char>(text[i + k])} << (8 * k);
  mix(state, rest);
}

}  // namespace pssmlt
