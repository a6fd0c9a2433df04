// The session behind render(): layers, rounds, budgets, checkpoints.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "core/render/checkpoint.h"
#include "core/render/film.h"
#include "core/render/render.h"
#include "core/render/worker_pool.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/scene/scene.h"

namespace pssmlt {

// One thread's tools for one layer.
struct LayerTools {
  LayerTools(const Integrator& integrator, const RasterMap& map, RejectionLog& log, bool keep_tags);
  PrimarySampleOwner sample;
  Splats splats;
  Workspace workspace;
  Evaluator evaluator;
  Worker worker;
};

// Layers have seeds of their own; the first one's is the render's.
inline uint64_t layer_seed(uint64_t seed, size_t layer) {
  return layer == 0 ? seed : mix_bits(seed + layer * 0x9E3779B97F4A7C15ull);
}

// A layer while it renders.
struct LayerState {
  const Layer* layer = nullptr;
  uint64_t seed = 0;
  int rounds = 0;
  double samples = 0.0;
  double share = 0.0;          // samples this layer gets for every share of the others
  double target = 0.0;         // samples after which it is done; 0: no such budget
  double start_seconds = 0.0;  // of Sampler::start [s]
  std::vector<std::unique_ptr<LayerTools>> tools;  // per slot, made at first use
  bool done() const { return target > 0.0 && samples >= target; }
};

class Session {
 public:
  Session(const BuiltScene& scene, const RenderSettings& settings,
          const RenderCallbacks& callbacks);
  RenderResult run();

 private:
  using Clock = std::chrono::steady_clock;
  void check_settings() const;
  void make_layers();
  void prepare();
  void start_layer(LayerState& layer);
  LayerTools& tools(LayerState& layer, int slot);
  void run_units(LayerState& layer, int count, const std::function<void(int, int)>& body);
  LayerState* next_layer();
  void run_passes(LayerState& layer);
  void run_round(LayerState& layer);
  bool stop_now();
  bool every_layer_has_a_round() const;
  bool interrupted() const;
  double elapsed() const;
  void after_round();
  void show_preview();
  void report_progress(double unfinished_samples);
  double fraction_done(double samples) const;
  void refresh_error();
  bool error_reached();
  void checkpoint();
  void read_saved_state();
  void resume();
  CheckpointIdentity identity() const;
  Developer developer() const;
  RenderResult result(bool final_result) const;
  nlohmann::json statistics(const RenderResult& result) const;
  nlohmann::json layer_statistics(const LayerState& layer) const;
  nlohmann::json rejection_statistics() const;

  const BuiltScene& scene_;
  const RenderSettings& settings_;
  const RenderCallbacks& callbacks_;
  WorkerPool pool_;
  Film film_;
  RejectionLog rejections_;
  std::vector<LayerState> layers_;
  std::vector<BlockSums> block_sums_;  // per slot
  std::vector<RayCounters> rays_;      // per slot
  RayCounters earlier_rays_;           // of the runs that were resumed
  std::array<uint64_t, rejection_count> earlier_rejections_{};
  double earlier_seconds_ = 0.0;
  Clock::time_point begin_ = Clock::now();
  RenderPhase phase_ = RenderPhase::prepare;
  double round_seconds_ = 0.0;                                             // of the last round [s]
  double next_progress_ = 0.0, next_checkpoint_ = 0.0, next_error_ = 0.0;  // [s] of elapsed()
  double next_preview_ = 0.0;                                              // the same
  double checkpoint_cost_ = 0.0;  // wall time spent writing checkpoints [s]
  size_t next_snapshot_ = 0;
  double samples_now_ = 0.0;  // made by the units of this round so far, for progress
  std::optional<ErrorEstimate> error_;
  StopReason stop_ = StopReason::samples;
  bool resumed_ = false;
  std::optional<std::string> saved_state_;  // of the checkpoint, until it is loaded
};

}  // namespace pssmlt
