// Runs the program, as a user would, in a temporary folder.
#pragma once

#include <filesystem>
#include <string>

namespace pssmlt::stress {

// Removed with everything in it when it goes.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

struct ProcessResult {
  int exit_code = -1;  // 128 + the signal's number if one ended it; 124: it hung
  std::string text;    // what it printed, errors included
};

// Runs `script` by sh in the folder; $PSSMLT is the program. Ended after `seconds`.
ProcessResult run_script(const WorkFolder& folder, const std::string& program,
                         const std::string& script, double seconds = 60.0);

}  // namespace pssmlt::stress
