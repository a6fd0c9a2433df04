// Pictures of generated scenes: rendered in steps until they are precise enough to decide.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/stress/case.h"
#include "core/render/session.h"

namespace pssmlt::stress {

// What to render and how.
struct Job {
  std::string scene;  // text
  Pair pair;
  std::vector<std::string> set = {};
  uint64_t seed = 1;
  int threads = 0;  // 0: all
};

// Throws Error as parser and builder do. Lines for the user are appended to `log`.
BuiltScene build_job(const Job& job, std::vector<std::string>* log);

// Block means of the groups of samples, which are independent, and last those of the whole.
struct Blocks {
  std::vector<std::vector<double>> values;  // [block][group]
  std::vector<double> common;  // [block] standard deviation of what all groups have in common
};

// What a render's record says beside the picture.
struct RenderFigures {
  uint64_t dropped = 0;
  std::string causes;  // of dropped samples, "negative 12, infinite 3, by material \"x\" 15"
  double rays_per_second = 0.0;
  std::optional<double> acceptance;
  std::optional<uint64_t> longest_stuck;
};

// One render. Errors of loading are thrown by the constructor.
class Picture {
 public:
  explicit Picture(const Job& job);
  // Makes at least so many samples a pixel more, and all groups get the same number of them.
  void add(double samples_per_pixel);
  double seconds() const;
  double samples_per_pixel() const { return samples_; }
  Blocks blocks() const;
  Image image() const;
  RenderFigures figures() const;
  nlohmann::json layer() const;  // statistics of the only layer
  const BuiltScene& scene() const { return scene_; }
  // What was said while the scene was loaded and the sampler was prepared.
  const std::vector<std::string>& log() const { return log_; }

 private:
  std::vector<std::string> log_;
  BuiltScene scene_;
  RenderSettings settings_;
  RenderCallbacks callbacks_;
  std::unique_ptr<Session> session_;
  int rounds_ = 0;
  double samples_ = 0.0;  // a pixel
};

}  // namespace pssmlt::stress
