// Invented comparisons for tests of the report's page: they follow the schema in docs/report.md and
// know nothing of the renderer.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pssmlt::sample {

struct Settings {
  int techniques = 3, scenes = 1, runs = 3, snapshots = 12;
  int width = 320, height = 180;
  bool partial = false, biased = false;
  bool gaps = false;     // numbers that are null, tables that are missing
  bool hostile = false;  // names that are HTML
  bool bare = false;     // pictures only, no reference: a comparison that has just begun
};

// What a technique's picture of `scene` is after `seconds`; infinite time: the reference.
class Pictures {
 public:
  Pictures(int width, int height, int scene) : width_(width), height_(height), scene_(scene) {}
  // Row-major RGB. `technique` chooses the noise: speckles, or blotches as of Markov chains.
  std::vector<float> render(int technique, double seconds) const;

 private:
  int width_, height_, scene_;
};

// The data without their pictures; image ids are "<scene>-<technique>-<snapshot>" and
// "<scene>-reference", by number.
nlohmann::json data(const Settings& settings);
// Data and pictures, by ReportWriter.
void write_report(const std::filesystem::path& folder, const Settings& settings);

}  // namespace pssmlt::sample
