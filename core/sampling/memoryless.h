// Base of the samplers that are not Markov chains: rounds of one sample for every pixel. A concrete
// sampler only says which numbers a sample has.
#pragma once

#include <array>
#include <vector>

#include "core/sampler.h"
#include "core/sampling/raster_map.h"

namespace pssmlt {

// Which sample of the picture this is. Sweep k gives every pixel its k-th sample. Even and odd
// sweeps are the two halves. Pixels of one remainder modulo 4 in x and in y are a part: the 16
// parts are interleaved, so that every block of pixels has all of them (narrow pictures: modulo 16
// in their order). Pictures of less than 16 pixels give each pixel's samples to 8 parts in turn.
struct SampleId {
  uint32_t pixel = 0;        // index in the window, row major
  uint32_t part = 0;         // below pair_count
  uint32_t place = 0;        // of the pixel within its part
  uint32_t part_pixels = 1;  // places of a part, of which some may be empty
  uint32_t turn = 0;         // pictures of less than 16 pixels: the part, else 0
  uint64_t sweep = 0;
  uint64_t nth = 0;  // of this pixel's samples of this half and turn
  uint32_t half() const { return static_cast<uint32_t>(sweep % 2); }
  // Together with the pixel, names samples that may depend on each other.
  uint32_t sequence() const { return 2 * turn + half(); }
  int group() const { return static_cast<int>(2 * part + half()); }
};

// Pictures of more than 2^21 pixels are served in interleaved subsets, one a round, so that a round
// stays short.
//
// The error is told from the difference of even and odd sweeps in 16 parts of the pixels. Samplers
// therefore see to it that samples of different halves and of different parts are independent;
// those of one half may depend on each other within a part, and do, to be even.
//
// One plane suffices while all pixels have the same count: camera splats divide by their pixel's
// count and light splats by the mean count. With subsets the counts differ within a sweep, and
// light splats have a plane of their own (1).
class MemorylessSampler : public Sampler {
 public:
  void start(const SamplerContext& context) override;
  double default_spp() const override { return spp_; }
  int units(int64_t round) const override { return (void)round, tiles_.x * tiles_.y; }
  double samples(int64_t round) const override { return subset_pixels_[subset_of_round(round)]; }
  void run(int64_t round, int unit, SplatSink& sink, Worker& worker) override;
  int planes() const override { return subsets() > 1 ? 2 : 1; }
  int subsets() const override { return subsets_; }
  int subset_of(int pixel) const override;
  double scale(int plane, int subset, int64_t rounds) const override;
  bool pairs_groups() const override { return true; }
  // With subsets, while a sweep is incomplete, the camera plane's factor is that of the mean count.
  double group_scale(int plane, int group, int64_t rounds) const override;
  bool replay(const std::string& key, Worker& worker) override;

 protected:
  // name: of the plugin, static; nullptr: samples are not named (Evaluator). spp: default samples
  // per pixel. seed: the scene's own.
  MemorylessSampler(const char* name, double spp, uint64_t seed)
      : name_(name), spp_(spp), scene_seed_(seed) {}
  // The four numbers of a block (index as in NumberSource) of a sample; a pure function.
  virtual void fill(const SampleId& id, Stream stream, uint32_t index,
                    NumberBlock& block) const = 0;
  // What becomes of a sample's splats before they are added; `camera`: where camera splats are
  // credited. A pure function. Returns what is left over for add_rest(), which is called after they
  // were added if that is more than 0.
  virtual double reshape(Splats& splats, const PixelCredit& camera) const {
    return (void)splats, (void)camera, 0.0;
  }
  // Adds what reshape() left over, in any way; the worker's sample is still the one it was. `plane`
  // takes splats that may land anywhere.
  virtual void add_rest(const SampleId& id, double rest, int plane, SplatSink& sink,
                        Worker& worker) const {
    (void)id, (void)rest, (void)plane, (void)sink, (void)worker;
  }
  // The sample of a pixel in a sweep: splats and numbers are left in the worker, nothing is added.
  // False if it was dropped.
  bool evaluate(const ivec2& at, uint64_t sweep, Worker& worker) const {
    return evaluate(sample_id(at, sweep), worker);
  }
  // Key of all random numbers: the scene's seed and the render's.
  uint64_t seed() const { return seed_; }

 private:
  class Source;
  bool evaluate(const SampleId& id, Worker& worker) const;
  size_t subset_of_round(int64_t round) const { return static_cast<size_t>(round % subsets_); }
  void run_pixel(const SampleId& id, int plane_of_light, SplatSink& sink, Worker& worker,
                 Splats& light) const;
  uint64_t samples_before(int64_t rounds) const;
  uint64_t group_samples(int group, int64_t rounds) const;
  SampleId sample_id(const ivec2& at, uint64_t sweep) const;

  const char* name_;
  double spp_;
  uint64_t scene_seed_, seed_ = 0;
  ivec2 size_{0, 0}, tiles_{0, 0};
  int subsets_ = 1;
  std::vector<uint32_t> subset_pixels_{0};                     // pixels of each subset
  std::vector<std::array<uint32_t, pair_count>> part_pixels_;  // the same by part
};

}  // namespace pssmlt
