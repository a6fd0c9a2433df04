#include "app/stress/picture.h"

#include <nlohmann/json.hpp>

#include "app/defaults.h"
#include "core/base/log.h"
#include "core/scene/parser.h"

namespace pssmlt::stress {
namespace {

// A session without end: whoever steps decides when to stop.
constexpr double endless_samples = 1e15;

}  // namespace

BuiltScene build_job(const Job& job, std::vector<std::string>* log) {
  BuildOptions options;
  options.defaults = default_plugins();
  if (!job.pair.integrator.empty()) options.integrator = job.pair.integrator;
  if (!job.pair.sampler.empty()) options.sampler = job.pair.sampler;
  options.set = job.set;
  BuiltScene built = build_scene(parse_string(job.scene, "stress-scene", "", log), options);
  if (log != nullptr) {
    log->insert(log->end(), built.log.begin(), built.log.end());
    log->insert(log->end(), built.warnings.begin(), built.warnings.end());
  }
  return built;
}

Picture::Picture(const Job& job) {
  const LogCapture capture;
  scene_ = build_job(job, &log_);
  settings_.spp = endless_samples;
  settings_.seed = job.seed;
  settings_.threads = job.threads;
  session_ = std::make_unique<Session>(scene_, settings_, callbacks_);
  session_->prepare();
  session_->hold();
  for (const std::string& line : capture.lines()) log_.push_back(line);
}

void Picture::add(double samples_per_pixel) {
  const LogCapture capture;
  session_->go_on();
  const double pixels = scene_.raster_map->frame().pixels();
  double made = 0.0;
  const Sampler& sampler = *scene_.layers.front().sampler;
  for (int i = 0; made < samples_per_pixel * pixels || i % group_count != 0; ++i, ++rounds_) {
    if (!session_->step()) break;
    made += sampler.samples(rounds_);
    samples_ += sampler.samples(rounds_) / pixels;
    if (sampler.is_chain() && made >= samples_per_pixel * pixels) break;  // all groups in a round
  }
  session_->hold();
}

double Picture::seconds() const { return session_->elapsed(); }

Blocks Picture::blocks() const {
  const GroupBlocks groups = session_->group_blocks();
  Blocks blocks;
  blocks.common = groups.common;
  if (groups.means.empty()) {  // chains that found no light: every group is black
    const ivec2 edges = (scene_.raster_map->frame().crop_size() + (groups.edge - 1)) / groups.edge;
    blocks.values.assign(static_cast<size_t>(edges.x * edges.y) + 1,
                         std::vector<double>(group_count, 0.0));
    blocks.common.assign(blocks.values.size(), 0.0);
    return blocks;
  }
  const size_t count = groups.means.front().size();
  blocks.values.resize(count + 1);
  double common = 0.0;
  for (const double block : groups.common) common += block / static_cast<double>(count);
  blocks.common.push_back(common);
  for (const std::vector<double>& group : groups.means) {
    double whole = 0.0;
    for (size_t b = 0; b < count; ++b) {
      blocks.values[b].push_back(group[b]);
      whole += group[b] / static_cast<double>(count);
    }
    blocks.values[count].push_back(whole);
  }
  return blocks;
}

Image Picture::image() const { return session_->result(false).image; }

nlohmann::json Picture::layer() const { return session_->result(false).statistics["layers"][0]; }

RenderFigures Picture::figures() const {
  const nlohmann::json s = session_->result(false).statistics;
  RenderFigures f;
  f.dropped = s["rejected"]["total"].get<uint64_t>();
  for (const auto& [cause, count] : s["rejected"]["causes"].items()) {
    f.causes +=
        (f.causes.empty() ? "" : ", ") + cause + " " + std::to_string(count.get<uint64_t>());
  }
  for (const auto& spoilt : s["rejected"]["plugins"]) {
    f.causes += ", by " + spoilt["plugin"].get<std::string>() + " " +
                std::to_string(spoilt["count"].get<uint64_t>());
  }
  f.rays_per_second = s["rays"]["per_second"].get<double>();
  const nlohmann::json& layer = s["layers"][0];
  if (!layer["chain"].get<bool>()) return f;
  const nlohmann::json& report = layer["report"];
  if (report.contains("acceptance_rate")) f.acceptance = report["acceptance_rate"].get<double>();
  if (report.contains("longest_stuck")) f.longest_stuck = report["longest_stuck"].get<uint64_t>();
  return f;
}

}  // namespace pssmlt::stress
