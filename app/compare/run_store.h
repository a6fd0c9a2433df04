// Finished runs in the report's folder, for --resume: runs/state.json says what they belong to, one
// file a run. Files are replaced atomically, so that whoever is killed loses the run in progress.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/compare/run_record.h"

namespace pssmlt::compare {

class RunStore {
 public:
  // `identity`: an object whose entries must be those of the runs that are there. With `resume`,
  // throws Error, naming what differs, if they are not; without it, earlier runs are removed.
  // Throws Failure if the folder cannot be written.
  RunStore(const std::filesystem::path& report, const nlohmann::json& identity, bool resume);
  // nullopt: not there, or damaged (said in the log). Throws Error if it was measured against
  // another reference.
  std::optional<std::vector<RunRecord>> load(int scene, int run, uint64_t reference) const;
  void save(int scene, int run, uint64_t reference, const std::vector<RunRecord>& records) const;

 private:
  std::string file(int scene, int run) const;
  std::filesystem::path folder_;
};

}  // namespace pssmlt::compare
