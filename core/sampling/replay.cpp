#include "core/sampling/replay.h"

#include <charconv>
#include <cstdio>

namespace pssmlt {
namespace {

// A vertex beyond this is no number an integrator ever read; it would only eat memory.
constexpr uint32_t largest_index = 1u << 20;

class ZeroSource final : public NumberSource {
 public:
  void fill(Stream, uint32_t, NumberBlock& block) override { block = {}; }
};

// Takes a number off the front of `text`; false if there is none.
template <typename T>
bool take_number(std::string_view& text, T& value, int base = 10) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

bool take_block(std::string_view& text, PrimarySampleOwner& owner) {
  uint32_t stream = 0, index = 0;
  if (!take_number(text, stream) || !take(text, '.')) return false;
  if (!take_number(text, index) || !take(text, '=')) return false;
  if (stream >= stream_count || index > largest_index || text.size() < 32) return false;
  NumberBlock& block = owner.restore(static_cast<Stream>(stream)).add(index);
  for (uint32_t& word : block) {
    std::string_view digits = text.substr(0, 8);
    if (!take_number(digits, word, 16) || !digits.empty()) return false;
    text.remove_prefix(8);
  }
  return true;
}

}  // namespace

std::string numbers_to_text(const PrimarySample& u) {
  std::string text = "u:";
  for (uint32_t s = 0; s < stream_count; ++s) {
    const StreamNumbers& numbers = u.held(static_cast<Stream>(s));
    for (uint32_t i = 0; i < numbers.end(); ++i) {
      const NumberBlock* block = numbers.find(i);
      if (block == nullptr) continue;
      char buffer[64];
      std::snprintf(buffer, sizeof(buffer), "%s%u.%u=%08x%08x%08x%08x", text.size() > 2 ? "," : "",
                    s, i, (*block)[0], (*block)[1], (*block)[2], (*block)[3]);
      text += buffer;
    }
  }
  return text;
}

bool numbers_from_text(std::string_view text, PrimarySampleOwner& owner) {
  static ZeroSource zeros;
  owner.begin(zeros);
  if (!text.starts_with("u:")) return false;
  text.remove_prefix(2);
  while (!text.empty()) {
    if (!take_block(text, owner)) return false;
    if (!text.empty() && !take(text, ',')) return false;
  }
  return true;
}

bool parse_sample_name(std::string_view text, SampleName& name) {
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  name.name = std::string(text.substr(0, colon));
  text.remove_prefix(colon + 1);
  if (!take_number(text, name.seed) || !take(text, ':')) return false;
  if (!take_number(text, name.pixel) || !take(text, ':')) return false;
  return take_number(text, name.index) && text.empty();
}

}  // namespace pssmlt
