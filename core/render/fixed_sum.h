// Sums of doubles that do not depend on the order of addition: 128-bit fixed point with quantum
// 2^-44 and range 2^51, kept as two 64-bit words so that threads can add with two relaxed atomic
// additions. Integer addition is associative, so sums, merges and resumed sums agree bit for bit.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

namespace pssmlt {

// One value: high * 2^-12 + low * 2^-44 with 0 <= low <= 2^32.
struct FixedValue {
  int64_t high = 0;
  uint64_t low = 0;
};

// Rounds to the quantum; values beyond +-2^50 are cut there, NaN becomes 0 (neither reaches a
// film: the evaluator drops such samples).
inline FixedValue to_fixed(double value) {
  constexpr double limit = 0x1p50;
  if (!(std::fabs(value) <= limit)) value = value > 0.0 ? limit : value < 0.0 ? -limit : 0.0;
  const double scaled = value * 0x1p12;
  const double whole = std::floor(scaled);
  return {static_cast<int64_t>(whole),
          static_cast<uint64_t>((scaled - whole) * 0x1p32 + 0.5)};
}

// A sum; the low word collects carries in its upper half until fold(). At most 2^31 values may be
// added between two folds.
class FixedSum {
 public:
  void add(const FixedValue& v) {
    high_ += v.high;
    low_ += v.low;
  }
  void add(const FixedSum& other) {
    high_ += other.high_ + static_cast<int64_t>(other.low_ >> 32);
    low_ += other.low_ & low_mask;
  }
  // From any thread, while others do the same; nobody may read or fold meanwhile.
  void add_atomic(const FixedValue& v) {
    // Most values are small or whole: spare the addition of zeros.
    if (v.high != 0) {
      std::atomic_ref<int64_t>(high_).fetch_add(v.high, std::memory_order_relaxed);
    }
    if (v.low != 0) std::atomic_ref<uint64_t>(low_).fetch_add(v.low, std::memory_order_relaxed);
  }
  // Moves the carries into the high word.
  void fold() {
    high_ += static_cast<int64_t>(low_ >> 32);
    low_ &= low_mask;
  }
  // The sum rounded to double; the same whether folded or not.
  double value() const {
    const int64_t high = high_ + static_cast<int64_t>(low_ >> 32);
    return static_cast<double>(high) * 0x1p-12 + static_cast<double>(low_ & low_mask) * 0x1p-44;
  }
  bool is_zero() const { return high_ == 0 && low_ == 0; }

 private:
  static constexpr uint64_t low_mask = 0xffffffffu;
  alignas(8) int64_t high_ = 0;
  alignas(8) uint64_t low_ = 0;
};

// Three channels of a pixel.
struct FixedRgb {
  FixedSum channel[3];
};

}  // namespace pssmlt
