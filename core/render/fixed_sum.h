// Sums of doubles that do not depend on the order of addition: 128-bit two's complement fixed point
// with quantum 2^-48 and range 2^79, in two 64-bit words. Integer addition is associative, so sums,
// merges and resumed sums agree bit for bit.
//
// Threads add with relaxed atomics: the low word returns its carry, and the high word is touched
// only if there is one or the value is beyond +-2^15. A value costs one atomic addition as a rule.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

namespace pssmlt {

// (high * 2^64 + low) * 2^-48.
struct FixedValue {
  int64_t high = 0;
  uint64_t low = 0;
};

// Two's complement.
inline FixedValue negated(const FixedValue& v) {
  const uint64_t low = ~v.low + 1;
  return {~v.high + (low == 0 ? 1 : 0), low};
}

// Rounds to the quantum; values beyond +-2^60 are cut there, NaN becomes 0 (neither reaches a
// film: the evaluator drops such samples).
inline FixedValue to_fixed(double value) {
  if (std::fabs(value) < 0x1p14) {
    const auto whole = static_cast<int64_t>(std::nearbyint(value * 0x1p48));
    return {whole >> 63, static_cast<uint64_t>(whole)};
  }
  // By magnitude, where splitting is exact.
  constexpr double limit = 0x1p60;
  double magnitude = std::fabs(value);
  if (!(magnitude <= limit)) magnitude = std::isnan(value) ? 0.0 : limit;
  const double high = std::floor(magnitude * 0x1p-16);
  const double low = (magnitude - high * 0x1p16) * 0x1p48;
  const FixedValue v{static_cast<int64_t>(high), static_cast<uint64_t>(low)};
  return value < 0.0 ? negated(v) : v;
}

inline double to_double(const FixedValue& v) {
  // By magnitude: the words of a small negative number are large.
  const FixedValue m = v.high < 0 ? negated(v) : v;
  const double magnitude =
      static_cast<double>(m.high) * 0x1p16 + static_cast<double>(m.low) * 0x1p-48;
  return v.high < 0 ? -magnitude : magnitude;
}

inline void add_fixed(uint64_t& low, int64_t& high, const FixedValue& v) {
  low += v.low;
  high += v.high + (low < v.low ? 1 : 0);
}

// From any thread, while others do the same; nobody may read meanwhile.
inline void add_fixed_atomic(uint64_t& low, int64_t& high, const FixedValue& v) {
  const uint64_t before =
      std::atomic_ref<uint64_t>(low).fetch_add(v.low, std::memory_order_relaxed);
  const int64_t more = v.high + (before + v.low < before ? 1 : 0);
  if (more != 0) std::atomic_ref<int64_t>(high).fetch_add(more, std::memory_order_relaxed);
}

class FixedSum {
 public:
  void add(const FixedValue& v) { add_fixed(low_, high_, v); }
  void add(const FixedSum& other) { add({other.high_, other.low_}); }
  // The sum rounded to double.
  double value() const { return to_double({high_, low_}); }

 private:
  int64_t high_ = 0;
  uint64_t low_ = 0;
};

}  // namespace pssmlt
