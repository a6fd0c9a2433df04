// What of a session goes into a checkpoint, and back.
#include <filesystem>

#include "core/base/archive.h"
#include "core/base/log.h"
#include "core/render/session.h"

namespace pssmlt {

CheckpointIdentity Session::identity() const {
  CheckpointIdentity id;
  id.scene = scene_.scene_hash;
  const uint64_t more[] = {settings_.seed, settings_.per_length ? 1u : 0u,
                           settings_.per_strategy ? 1u : 0u};
  id.settings = hash_bytes(more, sizeof more, scene_.settings_hash);
  id.plugins = plugins_hash();
  return id;
}

void Session::checkpoint() {
  const Clock::time_point start = Clock::now();
  Archive archive;
  archive.value(elapsed());
  RayCounters rays = earlier_rays_;
  for (const RayCounters& r : rays_) {
    rays.nearest += r.nearest;
    rays.shadow += r.shadow;
  }
  archive.value(rays);
  for (int cause = 0; cause < rejection_count; ++cause) {
    archive.value(earlier_rejections_[static_cast<size_t>(cause)] +
                  rejections_.of(static_cast<Rejection>(cause)));
  }
  const RejectionLog::Culprits culprits = all_culprits();
  archive.value<uint64_t>(culprits.size());
  for (const auto& [of, count] : culprits) {
    archive.text(of.first);
    archive.value(of.second);
    archive.value(count);
  }
  for (const LayerState& l : layers_) {
    archive.value(l.rounds);
    archive.value(l.samples);
    l.layer->sampler->save(archive);
    l.layer->integrator->save(archive);
  }
  film_.save(archive);
  try {
    write_checkpoint(settings_.checkpoint, identity(), archive.bytes());
  } catch (const Failure& failure) {
    log_warning(failure.what());
  }
  checkpoint_cost_ += std::chrono::duration<double>(Clock::now() - start).count();
}

void Session::read_saved_state() {
  if (!settings_.resume) return;
  if (settings_.checkpoint.empty()) throw Error("to resume, name the checkpoint file");
  if (!std::filesystem::exists(settings_.checkpoint)) {
    log_info("there is no checkpoint \"" + settings_.checkpoint + "\" yet: starting anew");
    return;
  }
  saved_state_ = read_checkpoint(settings_.checkpoint, identity());
}

void Session::resume() {
  if (!saved_state_) return;
  Archive archive(std::move(*saved_state_));
  saved_state_.reset();
  earlier_seconds_ = archive.get<double>();
  earlier_rays_ = archive.get<RayCounters>();
  for (uint64_t& count : earlier_rejections_) count = archive.get<uint64_t>();
  for (auto left = archive.get<uint64_t>(); left > 0; --left) {
    std::string plugin = archive.get_text();
    const auto cause = archive.get<Rejection>();
    earlier_culprits_[{std::move(plugin), cause}] = archive.get<uint64_t>();
  }
  for (LayerState& l : layers_) {
    l.rounds = archive.get<int64_t>();
    l.samples = archive.get<double>();
    l.layer->sampler->load(archive);
    l.layer->integrator->load(archive);
  }
  film_.load(archive);
  resumed_ = true;
}

}  // namespace pssmlt
