#include "core/sampling/primary_sample_owner.h"

#include <utility>

namespace pssmlt {
namespace {

constexpr unsigned bit(Stream stream) { return 1u << static_cast<unsigned>(stream); }

}  // namespace

PrimarySampleOwner::PrimarySampleOwner(const RasterMap& map) {
  sample_.raster_map_ = &map;
  for (size_t s = 0; s < stream_count; ++s) {
    current_[s] = &first_[s];
    proposed_[s] = &second_[s];
    sample_.streams_[s] = current_[s];
  }
}

void PrimarySampleOwner::begin(NumberSource& source) {
  sample_.source_ = &source;
  sample_.fixed_pixel_ = -1;
  for (size_t s = 0; s < stream_count; ++s) {
    current_[s]->clear();
    current_version_[s] = next_version_++;
  }
  set_raster_state({});
  show_current();
}

// The streams' numbers and versions of the current state, for sampling from then on.
void PrimarySampleOwner::show_current() {
  for (size_t s = 0; s < stream_count; ++s) {
    sample_.streams_[s] = current_[s];
    sample_.versions_[s] = {current_version_[s], current_version_[s]};
  }
  changed_ = 0;
}

void PrimarySampleOwner::begin_proposal(NumberSource& source, unsigned changed_streams) {
  sample_.source_ = &source;
  changed_ = changed_streams;
  current_raster_ = raster_state();
  const bool all_new = (changed_ & bit(Stream::shared)) != 0;
  for (size_t s = 0; s < stream_count; ++s) {
    const bool changed = (changed_ >> s & 1u) != 0;
    if (changed) {
      proposed_[s]->clear();
      sample_.streams_[s] = proposed_[s];
    }
    if (changed || all_new) sample_.versions_[s].now = next_version_++;
  }
  if (changed_ & bit(Stream::camera)) set_raster_state({});
}

void PrimarySampleOwner::accept() {
  for (size_t s = 0; s < stream_count; ++s) {
    if (changed_ >> s & 1u) std::swap(current_[s], proposed_[s]);
    current_version_[s] = sample_.versions_[s].now;
  }
  show_current();
}

void PrimarySampleOwner::reject() {
  // A proposal that kept the camera stream may have found the current state's raster position.
  if (changed_ & bit(Stream::camera)) set_raster_state(current_raster_);
  show_current();
}

PrimarySampleOwner::RasterState PrimarySampleOwner::raster_state() const {
  return {sample_.raster_, sample_.raster_pixel_, sample_.raster_weight_, sample_.raster_known_};
}

void PrimarySampleOwner::set_raster_state(const RasterState& state) {
  sample_.raster_ = state.raster;
  sample_.raster_pixel_ = state.pixel;
  sample_.raster_weight_ = state.weight;
  sample_.raster_known_ = state.known;
}

}  // namespace pssmlt
