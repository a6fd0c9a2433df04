// References that were made once: <cache>/pssmlt/references/<key>/ with the picture, what is known
// about it and the states of both renders, which a longer time continues.
#pragma once

#include <atomic>
#include <filesystem>

#include "app/compare/reference.h"

namespace pssmlt::compare {

struct ReferenceRequest {
  std::vector<Technique> techniques;  // two
  double seconds = 600.0;             // wall time of both together
  int threads = 0;
  double slice = 0.25;  // [s]
  const std::atomic<bool>* stop = nullptr;
  // Called after every slice with the seconds of both so far; may be empty.
  std::function<void(double)> progress;
};

// $XDG_CACHE_HOME or ~/.cache, and below it.
std::filesystem::path reference_folder();
// Names what a reference depends on: the scene's text and the files that its parameters name, size,
// crop, both techniques' plugins and parameters, all plugins' files and the program's version.
std::string reference_key(const LoadedScene& scene, const BuildOptions& base,
                          const std::vector<Technique>& techniques);
// Seeds of the two renders: far from those that people choose.
uint64_t reference_seed(int technique);

// From the cache if it has had its time there, else made or continued. nullopt: interrupted; what
// was rendered is kept. Waits while another process makes the same one. A cache that cannot be
// written is a warning.
std::optional<Reference> make_reference(const LoadedScene& scene, const BuildOptions& base,
                                        const ReferenceRequest& request);

}  // namespace pssmlt::compare
