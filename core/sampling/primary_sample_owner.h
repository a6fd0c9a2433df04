// The sampler's face of a PrimarySample: sets numbers, versions and the raster mapping.
#pragma once

#include "core/sampling/primary_sample.h"
#include "core/sampling/raster_map.h"

namespace pssmlt {

class PrimarySampleOwner {
 public:
  explicit PrimarySampleOwner(const RasterMap& map);

  PrimarySample& sample() { return sample_; }

  // Starts a fresh point: nothing read, all versions new. `source` fills what is read from now on.
  void begin(NumberSource& source);
  // Fixes the pixel (index in the window): the raster pair then only chooses the offset within the
  // filter. -1: the pair ranges over the whole window (Markov chains, the default of begin()).
  void set_pixel(int pixel) { pixel_ = pixel; }

  // Two buffers a stream, for chains: `current` and `proposed`. begin_proposal() makes the streams
  // in the mask (bit = Stream) read from the cleared proposed buffer with a new version; the others
  // keep the current one's numbers and version. accept() swaps the changed streams, reject() goes
  // back; after either, sample() shows the current state again.
  void begin_proposal(NumberSource& source, unsigned changed_streams);
  void accept();
  void reject();
  // Current state's numbers of a stream (to mutate from, to store a chain).
  const StreamNumbers& current(Stream stream) const;
  // For restoring a stored chain: clears and returns the current buffer; call after begin().
  StreamNumbers& restore(Stream stream);

  // Credit of camera splats for the numbers of the last evaluation; pixel -1 if the integrator did
  // not read the raster pair (its camera splats, if any, are an error that is counted).
  PixelCredit credit() const { return {sample_.raster_pixel_, sample_.raster_weight_}; }
  // Fixed pixel in force, for PrimarySample::find_raster.
  int pixel() const { return pixel_; }

 private:
  PrimarySample sample_;
  std::array<StreamNumbers, stream_count> first_, second_;
  std::array<StreamNumbers*, stream_count> current_{}, proposed_{};
  std::array<uint64_t, stream_count> current_version_{};
  unsigned changed_ = 0;
  uint64_t next_version_ = 1;
  int pixel_ = -1;
  bool proposing_ = false;
};

}  // namespace pssmlt
