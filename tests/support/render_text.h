// Renders scenes given as text, as the command would, and estimates block means with their errors
// from independent renders.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/defaults.h"
#include "core/plugin/registry.h"
#include "core/render/render.h"
#include "core/scene/parser.h"
#include "tests/support/student.h"

namespace pssmlt::test {

// What to render, how, and how long.
struct Job {
  std::string scene;            // text
  std::string integrator = {};  // "": the scene's
  std::string sampler = {};
  std::vector<std::string> set = {};  // as --set
  double spp = 16;                    // samples or mutations per pixel
  std::optional<std::array<int, 4>> crop = {};
  std::optional<ivec2> size = {};
  bool per_length = false;
  int threads = 1;
};

inline BuiltScene build_text(const Job& job) {
  BuildOptions options;
  options.defaults = default_plugins();
  if (!job.integrator.empty()) options.integrator = job.integrator;
  if (!job.sampler.empty()) options.sampler = job.sampler;
  options.set = job.set;
  options.crop = job.crop;
  options.size = job.size;
  return build_scene(parse_string(job.scene, "test-scene", PSSMLT_SOURCE_DIR), options);
}

inline RenderResult render_text(const Job& job, uint64_t seed) {
  RenderSettings settings;
  settings.spp = job.spp;
  settings.threads = job.threads;
  settings.seed = seed;
  settings.per_length = job.per_length;
  return render(build_text(job), settings);
}

// Luminance means over blocks of edge x edge pixels, row by row; the last blocks of a row or column
// are smaller if the size is no multiple. edge 0: one block, the whole picture.
inline std::vector<double> block_means(const Image& image, int edge) {
  if (edge == 0) edge = std::max(image.width, image.height);
  const int across = (image.width + edge - 1) / edge, down = (image.height + edge - 1) / edge;
  std::vector<double> sums(static_cast<size_t>(across * down)), counts(sums.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* c = image.pixel(x, y);
      const auto b = static_cast<size_t>(y / edge * across + x / edge);
      sums[b] += static_cast<double>(luminance(Rgb(c[0], c[1], c[2])));
      counts[b] += 1.0;
    }
  }
  for (size_t b = 0; b < sums.size(); ++b) sums[b] /= counts[b];
  return sums;
}

// Block means of independent renders with the seeds first, first + 1, ...: [block][render].
using BlockValues = std::vector<std::vector<double>>;
inline BlockValues render_blocks(const Job& job, int renders, int edge, uint64_t first_seed = 1) {
  BlockValues values;
  for (int r = 0; r < renders; ++r) {
    const RenderResult result = render_text(job, first_seed + static_cast<uint64_t>(r));
    const std::vector<double> means = block_means(result.image, edge);
    values.resize(means.size());
    for (size_t b = 0; b < means.size(); ++b) values[b].push_back(means[b]);
  }
  return values;
}

// Names of the techniques that are there, new ones included.
inline std::vector<std::string> integrators() { return Registry::instance().names("integrator"); }
inline std::vector<std::string> samplers() { return Registry::instance().names("sampler"); }

// Budgets of small renders: a picture of a few pixels needs no 100000 bootstrap samples.
inline std::vector<std::string> small_chains(int bootstrap, int chains = 32) {
  return {"sampler.bootstrapsamples=" + std::to_string(bootstrap),
          "sampler.chains=" + std::to_string(chains)};
}
// True if the sampler answers to these settings: told from its documented parameters.
inline bool has_parameter(const std::string& kind, const std::string& plugin,
                          const std::string& name) {
  const FoundPlugin found = Registry::instance().find(kind, plugin, {});
  for (const ParameterDoc& doc : describe(*found.descriptor)) {
    if (doc.name == name) return true;
  }
  return false;
}

}  // namespace pssmlt::test
