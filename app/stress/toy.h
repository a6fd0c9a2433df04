// Targets with closed forms, for samplers without light: an integrator made of a function,
// a film that is an array, and threads that are a loop.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/path/path_expression.h"
#include "core/plugin/registry.h"
#include "core/sampler.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/scene/scene.h"

namespace pssmlt::stress {

class BoxFilter final : public Filter {
 public:
  explicit BoxFilter(vec2 radius = vec2(0.5f)) : radius_(radius) {}
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2& offset) const override {
    return std::abs(offset.x) <= radius_.x && std::abs(offset.y) <= radius_.y ? 1.f : 0.f;
  }

 private:
  vec2 radius_;
};

inline RasterFrame frame_of(int width, int height) {
  RasterFrame frame;
  frame.resolution = frame.crop_max = {width, height};
  return frame;
}
inline RasterMap box_map(int width, int height) {
  return {frame_of(width, height), std::make_shared<BoxFilter>()};
}

// f(u) as a function.
class ToyIntegrator final : public Integrator {
 public:
  using Function = std::function<void(PrimarySample&, Splats&)>;
  explicit ToyIntegrator(Function function, bool fixed = true)
      : function_(std::move(function)), fixed_(fixed) {}
  void prepare(const Scene&) override {}
  void sample(PrimarySample& u, Splats& out, Workspace&) const override { function_(u, out); }
  std::string sees() const override { return "L.*E"; }
  bool splats_light() const override { return true; }
  const PathLimits& limits() const override { return limits_; }
  bool fixed() const override { return fixed_; }

 private:
  Function function_;
  bool fixed_;
  PathLimits limits_;
};

// Sums of luminance by plane, pixel and group.
class ToyFilm final : public SplatSink {
 public:
  ToyFilm(const RasterMap& map, int planes)
      : map_(map),
        pixels_(static_cast<size_t>(map.frame().pixels())),
        sums_(static_cast<size_t>(planes) * pixels_ * group_count) {}
  void add(int plane, const Splats& splats, const PixelCredit& camera, double weight,
           int group) override {
    for (const Splat& splat : splats.all()) {
      const PixelCredit credit = splat.from_camera ? camera : map_.pick(splat.raster, 0.5f);
      if (credit.pixel < 0) continue;
      sum(plane, credit.pixel, group) +=
          weight * static_cast<double>(credit.weight) * static_cast<double>(luminance(splat.value));
      ++adds_;
    }
  }
  double& sum(int plane, int pixel, int group) {
    const size_t row = static_cast<size_t>(plane) * group_count + static_cast<size_t>(group);
    return sums_[row * pixels_ + static_cast<size_t>(pixel)];
  }
  // All groups of a pixel.
  double sum(int plane, int pixel) {
    double total = 0.0;
    for (int g = 0; g < group_count; ++g) total += sum(plane, pixel, g);
    return total;
  }
  const std::vector<double>& all() const { return sums_; }
  size_t adds() const { return adds_; }

 private:
  const RasterMap& map_;
  size_t pixels_;
  std::vector<double> sums_;
  size_t adds_ = 0;
};

// A sampler over a toy integrator, round by round.
class ToyRender {
 public:
  ToyRender(const std::string& sampler, const ParameterSet& set, ToyIntegrator::Function function,
            const RasterMap& map, uint64_t seed, bool fixed = true)
      : integrator_(std::move(function), fixed),
        evaluator_(integrator_, log_),
        owner_(map),
        worker_{owner_, splats_, workspace_, evaluator_},
        sampler_(make(sampler, set)) {
    sampler_->start({scene_, integrator_, map, seed,
                     [this](int count, const std::function<void(int, Worker&)>& body) {
                       for (int unit = 0; unit < count; ++unit) body(unit, worker_);
                     }});
    film_ = std::make_unique<ToyFilm>(map, sampler_->planes());
  }
  static std::shared_ptr<Sampler> make(const std::string& name, const ParameterSet& set) {
    const FoundPlugin found = Registry::instance().find("sampler", name, {});
    Parameters p(set, {}, "sampler \"" + name + "\"", nullptr);
    return make_plugin<Sampler>(found, p);
  }
  // backwards: units in the other order, as another number of threads might.
  void rounds(int count, bool backwards = false) {
    for (int i = 0; i < count; ++i, ++rounds_) {
      const int units = sampler_->units(rounds_);
      for (int unit = 0; unit < units; ++unit) {
        sampler_->run(rounds_, backwards ? units - 1 - unit : unit, *film_, worker_);
      }
    }
  }
  // Value of a pixel of the picture.
  double pixel(int p) {
    double value = 0.0;
    for (int plane = 0; plane < sampler_->planes(); ++plane) {
      value += sampler_->scale(plane, sampler_->subset_of(p), rounds_) * film_->sum(plane, p);
    }
    return value;
  }
  Sampler& sampler() { return *sampler_; }
  ToyFilm& film() { return *film_; }
  Worker& worker() { return worker_; }
  RejectionLog& log() { return log_; }
  int64_t rounds() const { return rounds_; }
  void set_rounds(int64_t rounds) { rounds_ = rounds; }

 private:
  Scene scene_;
  RejectionLog log_;
  ToyIntegrator integrator_;
  Evaluator evaluator_;
  Splats splats_;
  Workspace workspace_;
  PrimarySampleOwner owner_;
  Worker worker_;
  std::shared_ptr<Sampler> sampler_;
  std::unique_ptr<ToyFilm> film_;
  int64_t rounds_ = 0;
};

}  // namespace pssmlt::stress
