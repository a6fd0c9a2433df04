// Jittered strata (Cook 1986, Stochastic Sampling in Computer Graphics): every pair of numbers of a
// pixel visits each cell of an xsamples x ysamples grid once in xsamples * ysamples samples, in an
// order of its own for each pair. Beyond that many samples the grid is visited again, in another
// order. Even and odd samples visit grids of their own, so that their difference tells the error.
// Good for smooth integrands of few dimensions; the strata do not get finer with time.
#include "core/plugin/plugin.h"
#include "core/sampling/memoryless.h"
#include "core/sampling/permutation.h"

namespace pssmlt {
namespace {

struct StrataSettings {
  int x, y;
  bool jitter;
  uint64_t seed;
};

class Stratified final : public MemorylessSampler {
 public:
  static constexpr const char* summary = "Jittered strata for every pair of numbers.";
  explicit Stratified(Parameters& p) : Stratified(read(p)) {}

 private:
  explicit Stratified(const StrataSettings& s)
      : MemorylessSampler("stratified", double(s.x) * s.y, s.seed),
        x_(static_cast<uint32_t>(s.x)),
        y_(static_cast<uint32_t>(s.y)),
        jitter_(s.jitter) {}

  static StrataSettings read(Parameters& p) {
    StrataSettings s{};
    s.x = p.integer("xsamples", 4, "samples", "strata of a pixel in x");
    s.y = p.integer("ysamples", 4, "samples", "strata of a pixel in y");
    s.jitter = p.flag("jitter", true, "random position in a stratum, not its centre");
    s.seed =
        static_cast<uint32_t>(p.integer("seed", 0, "", "another seed gives another noise pattern"));
    const bool sane = s.x >= 1 && s.y >= 1 && int64_t{s.x} * s.y <= 1 << 24;
    if (!sane) p.fail("xsamples * ysamples must lie between 1 and 2^24");
    return s;
  }

  void fill(const SampleId& id, Stream stream, uint32_t index, NumberBlock& block) const override {
    const uint32_t strata = x_ * y_;
    const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
    const uint32_t use =
        static_cast<uint32_t>(RandomUse::sample) | static_cast<uint32_t>(id.sweep >> 32) << 8;
    const uint64_t visit = id.nth / strata;  // of the whole grid
    const uint32_t order_use =
        static_cast<uint32_t>(RandomUse::decide) | static_cast<uint32_t>(visit >> 32) << 8;
    const RandomBlock order =
        philox(seed() + id.sequence(), {static_cast<uint32_t>(visit), id.pixel, what, order_use});
    RandomBlock inside{1u << 31, 1u << 31, 1u << 31, 1u << 31};
    if (jitter_) {
      inside = philox(seed(), {static_cast<uint32_t>(id.sweep), id.pixel, what, use});
    }
    for (size_t pair = 0; pair < 2; ++pair) {
      const uint32_t cell = permute(static_cast<uint32_t>(id.nth % strata), strata, order[pair]);
      block[2 * pair] = place(cell % x_, x_, inside[2 * pair]);
      block[2 * pair + 1] = place(cell / x_, y_, inside[2 * pair + 1]);
    }
  }

  // Fixed-point position in cell `cell` of `count` cells.
  static uint32_t place(uint32_t cell, uint32_t count, uint32_t inside) {
    return static_cast<uint32_t>(((uint64_t{cell} << 32) + inside) / count);
  }

  uint32_t x_, y_;
  bool jitter_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "stratified", pssmlt::Stratified)
