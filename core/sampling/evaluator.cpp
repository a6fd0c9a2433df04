#include "core/sampling/evaluator.h"

#include <algorithm>
#include <limits>

#include "core/path/witness.h"
#include "core/sampling/replay.h"

namespace pssmlt {
namespace {

constexpr size_t example_count = 16;

// 2^40, or 2^40 scales where that is more; but never so much that the film's sums could overflow.
// The scale is that of the whole scene: what a picture shows of a huge one may be far brighter.
float largest_value(double radiance_scale) {
  const double largest = std::min(0x1p60 * radiance_scale, 0x1p40 * std::max(radiance_scale, 1.0));
  return static_cast<float>(
      std::min(largest, static_cast<double>(std::numeric_limits<float>::max())));
}

// What is wrong with one colour; false if nothing is.
bool find_fault(const Rgb& value, float largest, Rejection& cause) {
  for (int c = 0; c < 3; ++c) {
    const float v = value[c];
    if (v >= 0.f && v <= largest) continue;
    cause = std::isnan(v)   ? Rejection::nan
            : std::isinf(v) ? Rejection::infinite
            : v < 0.f       ? Rejection::negative
                            : Rejection::too_large;
    return true;
  }
  return false;
}

}  // namespace

std::string_view to_string(Rejection cause) {
  switch (cause) {
    case Rejection::nan:
      return "not a number";
    case Rejection::infinite:
      return "infinite";
    case Rejection::negative:
      return "negative";
    case Rejection::too_large:
      return "too large";
    case Rejection::threw:
      return "exception";
    case Rejection::no_raster:
      return "camera value without raster position";
  }
  return "";
}

void RejectionLog::count(Rejection cause, const std::string& key, const dvec2& raster,
                         const std::string& plugin) {
  counts_[static_cast<size_t>(cause)].fetch_add(1, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  ++culprits_[{plugin, cause}];
  if (examples_.size() < example_count) examples_.push_back({key, cause, raster});
}

bool RejectionLog::wants_examples() const {
  const std::lock_guard lock(mutex_);
  return examples_.size() < example_count;
}

uint64_t RejectionLog::total() const {
  uint64_t sum = 0;
  for (const auto& count : counts_) sum += count;
  return sum;
}

RejectionLog::Culprits RejectionLog::culprits() const {
  const std::lock_guard lock(mutex_);
  return culprits_;
}

std::vector<ReplayKey> RejectionLog::examples() const {
  const std::lock_guard lock(mutex_);
  return examples_;
}

Evaluator::Evaluator(const Integrator& integrator, RejectionLog& log, double radiance_scale)
    : integrator_(integrator), log_(log), largest_value_(largest_value(radiance_scale)) {}

void Evaluator::name_sample(const char* sampler, uint64_t seed, int64_t pixel, int64_t index) {
  sampler_ = sampler;
  seed_ = seed;
  pixel_ = pixel;
  index_ = index;
}

bool Evaluator::evaluate(PrimarySample& u, Splats& out, Workspace& workspace) {
  ++samples_;
  out.clear();
  try {
    integrator_.sample(u, out, workspace);
  } catch (...) {
    // Whatever it was, one bad sample must not end a render.
    drop(Rejection::threw, u, out);
    return false;
  }
  return check(u, out);
}

bool Evaluator::check(PrimarySample& u, Splats& out) {
  for (const Splat& splat : out.all()) {
    Rejection cause{};
    bool bad = find_fault(splat.value, largest_value_, cause);
    if (!bad && splat.from_camera && !u.raster_known()) {
      bad = true;
      cause = Rejection::no_raster;
    }
    if (!bad && !splat.from_camera) {
      bad = !std::isfinite(splat.raster.x) || !std::isfinite(splat.raster.y);
      cause = Rejection::nan;
    }
    if (!bad) continue;
    drop(cause, u, out);
    return false;
  }
  return true;
}

void Evaluator::drop(Rejection cause, PrimarySample& u, Splats& out) {
  const std::string plugin = log_.wants_culprits() ? culprit(u, out) : "not looked for";
  out.clear();
  std::string key;
  if (log_.wants_examples()) {
    key = sampler_ != nullptr ? std::string(sampler_) + ":" + std::to_string(seed_) + ":" +
                                    std::to_string(pixel_) + ":" + std::to_string(index_)
                              : numbers_to_text(u);
  }
  log_.count(cause, key, u.raster_known() ? u.raster() : dvec2(-1.0), plugin);
}

// In a workspace of its own: what this one keeps for later samples must not point at watched Bsdfs.
std::string Evaluator::culprit(PrimarySample& u, Splats& out) const {
  Witness witness;
  Workspace workspace;
  out.clear();
  try {
    integrator_.sample(u, out, workspace);
  } catch (...) {
    // It did so before, which is why we are here.
  }
  return witness.culprit().empty() ? integrator_.plugin_name() : witness.culprit();
}

}  // namespace pssmlt
