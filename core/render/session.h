// The session behind render(): layers, rounds, budgets, checkpoints.
#pragma once

#include <memory>
#include <vector>

#include "core/render/checkpoint.h"
#include "core/render/film.h"
#include "core/render/render.h"
#include "core/render/stopwatch.h"
#include "core/render/worker_pool.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/scene/scene.h"

namespace pssmlt {

// One thread's tools for one layer.
struct LayerTools {
  LayerTools(const Integrator& integrator, const RasterMap& map, RejectionLog& log, bool keep_tags,
             double radiance_scale = 1.0);
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
  int64_t rounds = 0;
  double samples = 0.0;
  double share = 0.0;          // samples this layer gets for every share of the others
  double target = 0.0;         // samples after which it is done; 0: no such budget
  double start_seconds = 0.0;  // of Sampler::start [s]
  std::vector<std::unique_ptr<LayerTools>> tools;  // per slot, made at first use
  bool done() const { return target > 0.0 && samples >= target; }
};

class Session {
 public:
  // Keeps references to all three. The clock runs from here.
  Session(const BuiltScene& scene, const RenderSettings& settings,
          const RenderCallbacks& callbacks);
  RenderResult run();

  // The pieces of run(), for those who let several sessions take turns: prepare() once, then step()
  // as often as wanted, the clock held while another session works or a picture is taken. The
  // film after n steps is that of run() after n rounds.
  // Reads the checkpoint if asked to, then bootstraps. Throws Error.
  void prepare();
  // One round. False, and nothing done, if all layers have the samples of a budget in samples;
  // budgets of time and error, snapshots and checkpoints are the caller's business here.
  bool step();
  void hold() { watch_.hold(); }
  void go_on() { watch_.go_on(); }
  // Counted wall time, earlier runs that were resumed included [s].
  double elapsed() const { return earlier_seconds_ + watch_.seconds(); }
  // Every layer has a round: pictures can be taken.
  bool has_picture() const;
  // final_result: with the images by path.
  RenderResult result(bool final_result) const;
  GroupBlocks group_blocks() const { return developer().group_blocks(); }
  // Writes the settings' checkpoint; what fails is a warning in the log.
  void checkpoint();

 private:
  using Clock = Stopwatch::Clock;
  void check_settings() const;
  void make_layers();
  void start_layer(LayerState& layer);
  LayerTools& tools(LayerState& layer, int slot);
  void run_units(int count, const std::function<void(int, int)>& body);
  LayerState* next_layer();
  void run_passes(LayerState& layer);
  void run_round(LayerState& layer);
  bool stop_now();
  bool interrupted() const;
  void after_round();
  void show_preview();
  void report_progress(double unfinished_samples);
  double fraction_done(double samples) const;
  void refresh_error();
  bool error_reached();
  void read_saved_state();
  void resume();
  CheckpointIdentity identity() const;
  Developer developer() const;
  nlohmann::json statistics(const RenderResult& result) const;
  nlohmann::json layer_statistics(const LayerState& layer) const;
  void add_efficiency(const Developer& developer, RenderResult& result) const;
  RejectionLog::Culprits all_culprits() const;
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
  RejectionLog::Culprits earlier_culprits_;
  double earlier_seconds_ = 0.0;
  Stopwatch watch_;
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
