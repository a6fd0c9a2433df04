#include "core/render/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pssmlt {
namespace {

constexpr double progress_interval = 0.1;  // [s]
// An error estimate is made when it costs less than 1/50 of the time since the last one.
constexpr double error_time_factor = 50.0;
constexpr double least_error_interval = 0.5;  // [s]
// A preview costs less than 1/100 of the time since the last one, all that its receiver does on
// this thread included.
constexpr double preview_time_factor = 100.0;
constexpr double least_preview_interval = 0.5;  // [s]

FilmSettings film_settings(const BuiltScene& scene, const RenderSettings& settings) {
  FilmSettings film;
  film.size = scene.raster_map->frame().crop_size();
  for (const Layer& layer : scene.layers) film.planes.push_back(layer.sampler->planes());
  film.split = {settings.per_length, settings.per_strategy};
  return film;
}

// Numbers of an integrator's pass: a function of (seed, round, unit) and the number's address.
class PassSource final : public NumberSource {
 public:
  PassSource(uint64_t seed, int64_t round, int unit)
      : seed_(mix_bits(seed ^ 0x70617373u) + (static_cast<uint64_t>(round) >> 32)),
        round_(static_cast<uint32_t>(round)),
        unit_(static_cast<uint32_t>(unit)) {}
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    const uint32_t use = static_cast<uint32_t>(RandomUse::sample) | static_cast<uint32_t>(stream)
                                                                        << 16;
    block = philox(seed_, {index, unit_, round_, use});
  }

 private:
  uint64_t seed_;
  uint32_t round_, unit_;
};

}  // namespace

std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::samples:
      return "samples";
    case StopReason::time:
      return "time";
    case StopReason::error:
      return "error";
    case StopReason::interrupted:
      return "interrupted";
  }
  return "";
}

LayerTools::LayerTools(const Integrator& integrator, const RasterMap& map, RejectionLog& log,
                       bool keep_tags, double radiance_scale)
    : sample(map),
      evaluator(integrator, log, radiance_scale),
      worker{sample, splats, workspace, evaluator} {
  splats.keep_tags(keep_tags);
}

Session::Session(const BuiltScene& scene, const RenderSettings& settings,
                 const RenderCallbacks& callbacks)
    : scene_(scene),
      settings_(settings),
      callbacks_(callbacks),
      pool_(settings.threads),
      film_(film_settings(scene, settings)) {
  check_settings();
  make_layers();
  for (int slot = 0; slot < pool_.threads(); ++slot) {
    block_sums_.push_back(film_.make_block_sums());
  }
  rays_.resize(static_cast<size_t>(pool_.threads()));
}

void Session::check_settings() const {
  const auto check = [](const std::optional<double>& value, const char* what) {
    if (value && !(*value > 0.0)) throw Error(std::string(what) + " must be greater than 0");
  };
  check(settings_.spp, "the number of samples per pixel");
  check(settings_.seconds, "the time budget");
  check(settings_.target_error, "the target error");
  if (scene_.layers.empty()) throw Error("the scene has no layers to render");
  for (const Layer& layer : scene_.layers) {
    if (!layer.sampler->is_chain()) continue;
    if (scene_.max_component < infinity) {
      throw Error("maxcomponentvalue clamps every sample; sampler \"" + layer.sampler_name +
                  "\" is a Markov chain, under which that is not possible");
    }
    if (!layer.integrator->fixed()) {
      throw Error("integrator \"" + layer.integrator_name +
                  "\" changes between rounds: it cannot be the target of sampler \"" +
                  layer.sampler_name + "\"");
    }
  }
}

void Session::make_layers() {
  const bool limited = settings_.seconds || settings_.target_error;
  for (size_t l = 0; l < scene_.layers.size(); ++l) {
    LayerState state;
    state.layer = &scene_.layers[l];
    state.seed = layer_seed(settings_.seed, l);
    state.share = settings_.spp.value_or(state.layer->sampler->default_spp()) * film_.pixels();
    if (settings_.spp || !limited) state.target = state.share;
    state.tools.resize(static_cast<size_t>(pool_.threads()));
    layers_.push_back(std::move(state));
  }
}

LayerTools& Session::tools(LayerState& layer, int slot) {
  auto& made = layer.tools[static_cast<size_t>(slot)];
  if (!made) {
    made = std::make_unique<LayerTools>(*layer.layer->integrator, *scene_.raster_map, rejections_,
                                        settings_.per_length || settings_.per_strategy,
                                        scene_.radiance_scale);
  }
  return *made;
}

// Runs the units and counts the rays that each slot traced meanwhile.
void Session::run_units(int count, const std::function<void(int, int)>& body) {
  pool_.run(count, [&](int unit, int slot) {
    const RayCounters before = ray_counters();
    body(unit, slot);
    RayCounters& sum = rays_[static_cast<size_t>(slot)];
    sum.nearest += ray_counters().nearest - before.nearest;
    sum.shadow += ray_counters().shadow - before.shadow;
  });
}

void Session::start_layer(LayerState& layer) {
  const Clock::time_point start = Clock::now();
  const auto parallel = [&](int count, const std::function<void(int, Worker&)>& body) {
    run_units(count, [&](int unit, int slot) {
      body(unit, tools(layer, slot).worker);
      if (slot == 0) report_progress(0.0);
    });
  };
  const bool clamped = scene_.max_component < infinity;
  const SamplerContext context{
      *scene_.scene, *layer.layer->integrator, *scene_.raster_map, layer.seed, parallel, clamped};
  layer.layer->sampler->start(context);
  layer.start_seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

void Session::prepare() {
  phase_ = RenderPhase::bootstrap;
  read_saved_state();  // refused before any time is spent
  for (LayerState& layer : layers_) start_layer(layer);
  resume();
  phase_ = RenderPhase::render;
  next_checkpoint_ = elapsed() + settings_.checkpoint_seconds;
  next_error_ = elapsed() + least_error_interval;
}

// The layer that is furthest behind its share; null if all are done.
LayerState* Session::next_layer() {
  LayerState* next = nullptr;
  for (LayerState& layer : layers_) {
    if (layer.done()) continue;
    if (next == nullptr || layer.samples / layer.share < next->samples / next->share) {
      next = &layer;
    }
  }
  return next;
}

void Session::run_passes(LayerState& layer) {
  Integrator& integrator = *layer.layer->integrator;
  const int count = integrator.passes(layer.rounds);
  if (count == 0) return;
  run_units(count, [&](int unit, int slot) {
    PassSource source(layer.seed, layer.rounds, unit);
    PrimarySampleOwner& owner = tools(layer, slot).sample;
    owner.begin(source);
    integrator.pass(layer.rounds, unit, owner.sample());
  });
  integrator.merge_passes(layer.rounds);
}

void Session::run_round(LayerState& layer) {
  const Clock::time_point start = Clock::now();
  run_passes(layer);
  Sampler& sampler = *layer.layer->sampler;
  const int units = sampler.units(layer.rounds);
  const double samples = sampler.samples(layer.rounds);
  UnitSink::Unit at;
  at.layer = static_cast<int>(&layer - layers_.data());
  at.seed = layer.seed;
  at.round = layer.rounds;
  at.clamp = scene_.max_component;
  at.factor = 1.0 / scene_.radiance_scale;
  std::atomic<int> finished{0};
  run_units(units, [&](int unit, int slot) {
    UnitSink::Unit mine = at;
    mine.unit = unit;
    UnitSink sink(film_, block_sums_[static_cast<size_t>(slot)], *scene_.raster_map, mine);
    sampler.run(layer.rounds, unit, sink, tools(layer, slot).worker);
    sink.flush();
    const int done = finished.fetch_add(1, std::memory_order_relaxed) + 1;
    if (slot == 0) report_progress(samples * done / units);
  });
  std::vector<BlockSums*> sums;
  for (BlockSums& s : block_sums_) sums.push_back(&s);
  film_.end_round(sums);
  ++layer.rounds;
  layer.samples += samples;
  round_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
}

bool Session::interrupted() const {
  return callbacks_.stop != nullptr && callbacks_.stop->load(std::memory_order_relaxed);
}

bool Session::has_picture() const {
  return std::all_of(layers_.begin(), layers_.end(),
                     [](const LayerState& l) { return l.rounds > 0; });
}

// True if the render ends here; says why in stop_.
bool Session::stop_now() {
  const auto stop = [this](StopReason reason) {
    stop_ = reason;
    return true;
  };
  if (interrupted()) return stop(StopReason::interrupted);
  if (next_layer() == nullptr) return stop(StopReason::samples);
  if (!has_picture()) return false;
  // The round that would end nearest to the budget is the last.
  if (settings_.seconds && elapsed() + 0.5 * round_seconds_ >= *settings_.seconds) {
    return stop(StopReason::time);
  }
  return error_reached() ? stop(StopReason::error) : false;
}

bool Session::error_reached() {
  if (!settings_.target_error) return false;
  if (elapsed() >= next_error_) refresh_error();
  return error_ && error_->known && error_->high <= *settings_.target_error;
}

void Session::refresh_error() {
  const Clock::time_point start = Clock::now();
  error_ = developer().error();
  const double cost = std::chrono::duration<double>(Clock::now() - start).count();
  next_error_ = elapsed() + std::max(least_error_interval, error_time_factor * cost);
}

void Session::show_preview() {
  if (!callbacks_.wants_preview || elapsed() < next_preview_ || !callbacks_.wants_preview()) return;
  const Clock::time_point start = Clock::now();
  Preview preview;
  preview.image = developer().picture(pool_);
  preview.seconds = elapsed();
  for (const LayerState& l : layers_) {
    preview.samples += l.samples;
    preview.layers.push_back(layer_statistics(l));
  }
  callbacks_.preview(std::move(preview));
  const double cost = std::chrono::duration<double>(Clock::now() - start).count();
  next_preview_ = elapsed() + std::max(least_preview_interval, preview_time_factor * cost);
}

void Session::after_round() {
  if (!has_picture()) return;
  show_preview();
  if (callbacks_.progress && elapsed() >= next_error_) refresh_error();
  const auto& times = settings_.snapshot_seconds;
  if (callbacks_.snapshot && next_snapshot_ < times.size() && elapsed() >= times[next_snapshot_]) {
    while (next_snapshot_ < times.size() && elapsed() >= times[next_snapshot_]) ++next_snapshot_;
    callbacks_.snapshot(result(false));
  }
  if (!settings_.checkpoint.empty() && elapsed() >= next_checkpoint_) {
    checkpoint();
    next_checkpoint_ = elapsed() + settings_.checkpoint_seconds;
  }
}

double Session::fraction_done(double samples) const {
  double fraction = 0.0;
  if (layers_.front().target > 0.0) {
    double target = 0.0;
    for (const LayerState& l : layers_) target += l.target;
    fraction = samples / target;
  }
  if (settings_.seconds) fraction = std::max(fraction, elapsed() / *settings_.seconds);
  if (settings_.target_error && error_ && error_->known) {
    // The error falls like 1 / samples.
    fraction = std::max(fraction, *settings_.target_error / error_->high);
  }
  return std::min(fraction, 1.0);
}

void Session::report_progress(double unfinished_samples) {
  if (!callbacks_.progress || elapsed() < next_progress_) return;
  Progress p;
  p.phase = phase_;
  p.samples = unfinished_samples;
  for (const LayerState& l : layers_) {
    p.samples += l.samples;
    p.chains = p.chains || l.layer->sampler->is_chain();
  }
  p.elapsed = elapsed();
  if (phase_ == RenderPhase::render) {
    p.fraction = fraction_done(p.samples);
    p.samples_per_second = p.samples / p.elapsed;
    if (p.fraction > 0.0) p.remaining = p.elapsed * (1.0 - p.fraction) / p.fraction;
  }
  p.error = error_ ? &*error_ : nullptr;
  callbacks_.progress(p);
  next_progress_ = elapsed() + progress_interval;
}

Developer Session::developer() const {
  std::vector<LayerScales> scales;
  for (const LayerState& l : layers_) scales.emplace_back(*l.layer->sampler, l.rounds);
  return Developer(film_, std::move(scales), scene_.radiance_scale * scene_.exposure,
                   scene_.balance);
}

bool Session::step() {
  LayerState* const layer = next_layer();
  if (layer == nullptr) return false;
  run_round(*layer);
  return true;
}

RenderResult Session::run() {
  prepare();
  while (!stop_now()) {
    step();
    report_progress(0.0);
    after_round();
  }
  RenderResult final_result = result(true);
  if (!settings_.checkpoint.empty()) checkpoint();
  return final_result;
}

void Session::add_efficiency(const Developer& developer, RenderResult& result) const {
  for (size_t l = 0; l < layers_.size(); ++l) {
    const int index = static_cast<int>(l);
    const Sampler& sampler = *layers_[l].layer->sampler;
    const auto e = chain_efficiency(film_, developer.scales(index), index, layers_[l].rounds);
    result.efficiency.push_back(e);
    for (std::string& w : sampler.warnings()) result.warnings.push_back(std::move(w));
    if (!e || !e->collapsed()) continue;
    const std::string change = sampler.remedy();
    result.warnings.push_back(fmt::format(
        "chains hardly move: {:.2g} effective samples a mutation in {}, whose noise the "
        "number of mutations does not tell; {}",
        e->worst.effective, to_string(e->worst.pixels),
        change.empty() ? "try another sampler" : "change " + change));
  }
}

RenderResult Session::result(bool final_result) const {
  RenderResult r;
  r.stop = stop_;
  r.complete = has_picture();
  r.seconds = elapsed();
  for (const LayerState& l : layers_) {
    r.samples += l.samples;
    r.rounds.push_back(l.rounds);
  }
  if (r.complete) {
    const Developer d = developer();
    r.image = d.picture();
    for (int h = 0; h < 2; ++h) r.half[h] = d.half(h);
    r.variance = d.variance();
    r.error = d.error();
    add_efficiency(d, r);
    if (final_result) {
      for (const SplitKind kind : {SplitKind::length, SplitKind::strategy}) {
        for (SplitImage& s : d.splits(kind)) r.splits.push_back(std::move(s));
      }
    }
  } else {
    r.error.why = "no round is complete";
  }
  r.statistics = statistics(r);
  return r;
}

RenderResult render(const BuiltScene& scene, const RenderSettings& settings,
                    const RenderCallbacks& callbacks) {
  return Session(scene, settings, callbacks).run();
}

}  // namespace pssmlt
