// Samplers answer "which points u are visited, and how are their splats weighted?". They explore
// primary sample space in rounds of independent units; the session runs the units of a round in
// parallel and gives every technique budgets, checkpoints and error estimates.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/integrator.h"

namespace pssmlt {

class RasterMap;
class Archive;

// Groups for the error estimate. Either each is an estimate of the whole picture, independent of
// the others (whole chains, each in one group for life); or they come in pairs
// (Sampler::pairs_groups()).
inline constexpr int group_count = 32;
inline constexpr int pair_count = group_count / 2;

// Where a sampler's splats go (the film's face for one unit of work).
class SplatSink {
 public:
  // Adds weight * every splat to a plane of the sampler. Camera splats go to `camera` (the credit
  // that PrimarySampleOwner::credit() gave for this u), light splats to a pixel of the filter's
  // support. `group` in [0, group_count).
  virtual void add(int plane, const Splats& splats, const struct PixelCredit& camera, double weight,
                   int group) = 0;

 protected:
  ~SplatSink() = default;
};

// One thread's tools, handed to every unit that runs on it.
struct Worker {
  class PrimarySampleOwner& sample;  // core/sampling/primary_sample_owner.h
  Splats& splats;
  Workspace& workspace;
  class Evaluator& evaluator;  // core/sampling/evaluator.h: calls the integrator safely
};

// Everything start() may use.
struct SamplerContext {
  const Scene& scene;
  Integrator& integrator;  // to choose among its alternatives; else not to be changed
  const RasterMap& raster_map;
  uint64_t seed = 0;
  // Runs body(unit, worker) for unit in [0, count) in parallel, returns when all are done.
  std::function<void(int count, const std::function<void(int, Worker&)>&)> parallel;
  bool clamped = false;  // what a sample adds is clamped by itself: no chains may spread it
};

class Sampler {
 public:
  virtual ~Sampler() = default;
  // Bootstrap, chain seeds. A pure function of the context's seed (not of thread count or clock).
  virtual void start(const SamplerContext& context) = 0;
  // Default budget [samples or mutations per pixel], from the scene's parameters.
  virtual double default_spp() const = 0;
  // Independent units of a round, and samples or mutations that the whole round makes.
  virtual int units(int64_t round) const = 0;
  virtual double samples(int64_t round) const = 0;
  // Runs one unit: a pure function of (seed, round, unit, the unit's own state).
  virtual void run(int64_t round, int unit, SplatSink& sink, Worker& worker) = 0;
  // Planes this sampler's splats use, and the factor that turns plane sums into radiance after
  // `rounds` whole rounds. Pixels may be served in interleaved subsets on large images:
  // subset_of(pixel) says which, scale() the factor there.
  virtual int planes() const { return 1; }
  virtual int subsets() const { return 1; }
  virtual int subset_of(int pixel) const { return (void)pixel, 0; }
  virtual double scale(int plane, int subset, int64_t rounds) const = 0;
  // Same for one group alone (the sum over groups of sums is the total): the factor that makes a
  // group's sum an estimate of the whole picture; 0 if the group has nothing yet.
  virtual double group_scale(int plane, int group, int64_t rounds) const = 0;
  // True: groups 2c and 2c + 1 hold samples of the same part c of the picture's samples (say, some
  // of its pixels), independent of each other and of other pairs; the sum over c is the picture.
  // The error is then told from the pairs' differences, which leaves samples of one group free to
  // depend on each other. group_scale() is that of the group's share of samples all the same.
  virtual bool pairs_groups() const { return false; }
  // Relative variance of a factor (b) that all groups' parts on the planes of chains
  // (is_chain_plane) have in common, to be added to the picture's.
  virtual double scale_relative_variance() const { return 0.0; }
  // True: where nobody named an integrator, one that offers all there are as alternatives is asked.
  virtual bool chooses_integrator() const { return false; }
  // True for Markov chains: samples are correlated; per-sample clamping and integrators whose
  // estimate changes between rounds are refused.
  virtual bool is_chain() const { return false; }
  // Errors of neighbouring pixels are correlated. Asked after start().
  virtual bool correlates_pixels() const { return is_chain(); }
  // For those who judge how well chains move: which planes are theirs, how many mutations they made
  // in `rounds` whole rounds, and how often they visit a place for its luminance there, relative to
  // others (position in the window [pixels]).
  virtual bool is_chain_plane(int plane) const { return (void)plane, is_chain(); }
  virtual double mutations(int64_t rounds) const {
    return is_chain() ? samples(0) * double(rounds) : 0.0;
  }
  virtual double visits(const dvec2& place) const { return (void)place, 1.0; }
  // State beyond (seed, round): chains, b. load() follows start() with the same context.
  virtual void save(Archive& archive) const { (void)archive; }
  virtual void load(Archive& archive) { (void)archive; }
  // Evaluates again the sample that a rejection named (core/sampling/replay.h): leaves its numbers
  // in worker.sample and its splats in worker.splats. False if the key is not this sampler's.
  virtual bool replay(const std::string& key, Worker& worker) {
    return (void)key, (void)worker, false;
  }
  // What the summary must say of these settings and of what start() found: reasons why light may be
  // missing or the error cannot be known.
  virtual std::vector<std::string> warnings() const { return {}; }
  // Empty if enough independent samples found light for the sampler's normalisation and its error
  // to be known; else why they are not. Nothing is then said about the picture's error.
  virtual std::string unknown_error() const { return ""; }
  // What to change where the picture's samples are worth too little (core/render/efficiency.h): a
  // parameter and why, from what has happened so far; "" if the sampler knows nothing to change.
  virtual std::string remedy() const { return ""; }
  // Acceptance rates, b and its error, ... for the summary and --json.
  virtual void report(nlohmann::json& statistics) const { (void)statistics; }
};

}  // namespace pssmlt
