// The sampler's face of a PrimarySample: sets numbers, versions and the raster mapping.
#pragma once

#include "core/sampling/primary_sample.h"
#include "core/sampling/raster_map.h"

namespace pssmlt {

class PrimarySampleOwner {
 public:
  explicit PrimarySampleOwner(const RasterMap& map);
  PrimarySampleOwner(const PrimarySampleOwner&) = delete;
  PrimarySampleOwner& operator=(const PrimarySampleOwner&) = delete;

  PrimarySample& sample() { return sample_; }

  // Starts a fresh point: nothing read, all versions new. `source` fills what is read from now on.
  void begin(NumberSource& source);
  // Fixes the pixel (index in the window): the raster pair then only chooses the offset within the
  // filter. -1: the pair ranges over the whole window (Markov chains, the default of begin()).
  // Call after begin().
  void set_pixel(int pixel) { sample_.fixed_pixel_ = pixel; }

  // Two buffers a stream, for chains: `current` and `proposed`. begin_proposal() makes the streams
  // in the mask (bit = Stream) read from the cleared proposed buffer with a new version; the others
  // keep the current one's numbers and version, and numbers that they add stay whatever comes of
  // the proposal, so that a version's numbers never change. (A point of primary sample space has
  // all its numbers from the start; which of them have been looked at does not matter.) accept()
  // swaps the changed streams, reject() goes back; after either, sample() shows the current state.
  void begin_proposal(NumberSource& source, unsigned changed_streams);
  void accept();
  void reject();
  // Current state's numbers of a stream (to mutate from, to store a chain).
  const StreamNumbers& current(Stream stream) const {
    return *current_[static_cast<size_t>(stream)];
  }
  // For restoring a stored chain: the current buffer to add to; call after begin(). If the state
  // had a raster position, call sample().raster() when all numbers are back.
  StreamNumbers& restore(Stream stream) { return *current_[static_cast<size_t>(stream)]; }

  // Credit of camera splats for the numbers of the last evaluation; pixel -1 if the integrator did
  // not read the raster pair (its camera splats, if any, are an error that is counted).
  PixelCredit credit() const { return {sample_.raster_pixel_, sample_.raster_weight_}; }

 private:
  struct RasterState {
    dvec2 raster{0.0};
    int pixel = -1;
    float weight = 0.f;
    bool known = false;
  };
  RasterState raster_state() const;
  void set_raster_state(const RasterState& state);
  void show_current();

  PrimarySample sample_;
  std::array<StreamNumbers, stream_count> first_, second_;
  std::array<StreamNumbers*, stream_count> current_{}, proposed_{};
  std::array<uint64_t, stream_count> current_version_{};
  RasterState current_raster_;
  unsigned changed_ = 0;
  uint64_t next_version_ = 1;
};

}  // namespace pssmlt
