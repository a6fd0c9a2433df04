// Primary sample space Metropolis light transport (Kelemen, Szirmay-Kalos, Antal, Csonka 2002, A
// Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm) over any
// integrator: many Markov chains whose stationary density is the luminance of the integrator's
// splats. Good where light is hard to find and small changes of a path keep it; noisier than
// independent samples where light is easy to find. Blind to what no bootstrap sample and no large
// step finds. Consistent: b is refined by every large step (or kept, then unbiased).
#include <array>

#include "core/base/log.h"
#include "core/excess/excess_pilots.h"
#include "core/excess/relative_target.h"
#include "core/metropolis/chain_population.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 2> target_names = {"luminance", "equalised"};

class Pssmlt final : public Sampler {
 public:
  static constexpr const char* summary = "Metropolis light transport in primary sample space.";
  explicit Pssmlt(Parameters& p)
      : settings_(read_population(p, 100000)),
        mutations_per_pixel_(
            p.integer("mutationsperpixel", 100, "mutations", "default budget, per pixel")),
        chains_("pssmlt", settings_) {
    equalised_ = p.choice("target", "luminance", target_names,
                          "scalar that the chains follow: the luminance, or that over the local "
                          "mean, for even relative errors (Hoberock and Hart 2010)") == "equalised";
    pilot_samples_ = p.integer("pilotsamples", 0, "samples",
                               "Sobol' points that give the local means, if equalised; 0: four a "
                               "pixel and more, fewer on large pictures");
    if (mutations_per_pixel_ < 1) {
      p.fail("mutationsperpixel", "\"mutationsperpixel\" must be positive");
    }
    if (pilot_samples_ < 0) p.fail("pilotsamples", "\"pilotsamples\" must not be negative");
  }

  void start(const SamplerContext& context) override;
  double default_spp() const override { return mutations_per_pixel_; }
  int units(int64_t) const override { return chains_.units(); }
  double samples(int64_t) const override { return chains_.mutations(); }
  void run(int64_t round, int unit, SplatSink& sink, Worker& worker) override {
    chains_.run(round, unit, 0, sink, worker);
  }
  int planes() const override { return settings_.kelemen_weights ? 2 : 1; }
  double scale(int plane, int, int64_t rounds) const override {
    return plane == 1 ? chains_.large_scale(rounds) : chains_.scale(rounds);
  }
  double group_scale(int plane, int, int64_t rounds) const override {
    return scale(plane, 0, rounds) * group_count;
  }
  double scale_relative_variance() const override { return chains_.scale_relative_variance(); }
  bool is_chain() const override { return true; }
  double visits(const dvec2& place) const override {
    return equalised_ ? 1.0 / mean_.at(corner_ + place) : 1.0;
  }
  void save(Archive& archive) const override { chains_.save(archive); }
  void load(Archive& archive) override { chains_.load(archive); }
  bool replay(const std::string& key, Worker& worker) override {
    return chains_.replay(key, worker);
  }
  std::vector<std::string> warnings() const override { return chains_.warnings(); }
  std::string unknown_error() const override { return chains_.unknown_error(); }
  std::string remedy() const override { return chains_.remedy(); }
  void report(nlohmann::json& statistics) const override { chains_.report(statistics); }

 private:
  PopulationSettings settings_;
  int mutations_per_pixel_;
  bool equalised_ = false;
  int pilot_samples_ = 0;
  LocalMean mean_;     // of the picture, if equalised
  dvec2 corner_{0.0};  // of the window [pixels]
  LuminanceTarget luminance_;
  RelativeTarget relative_{mean_};
  ChainPopulation chains_;
};

void Pssmlt::start(const SamplerContext& context) {
  if (!context.integrator.fixed()) {
    throw Error(
        "sampler \"pssmlt\": this integrator's estimate changes from round to round, so that "
        "no Markov chain can follow it; choose another sampler");
  }
  if (equalised_) {
    const uint64_t seed = mix_bits(mix_bits(context.seed + 0x70696C6F74u) + settings_.seed);
    mean_ = find_local_mean(context, seed, pilot_samples_);
    corner_ = dvec2(context.raster_map.frame().crop_min);
    chains_.start(context, relative_);
  } else {
    chains_.start(context, luminance_);
  }
  for (const std::string& warning : warnings()) log_warning(warning);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "pssmlt", pssmlt::Pssmlt)
