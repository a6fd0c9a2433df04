// Runs the built command in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pssmlt::test {

namespace fs = std::filesystem;

// A fresh folder that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }
  // Folders in `name` are made.
  void write(const std::string& name, const std::string& bytes) const;

 private:
  fs::path path_;
};

struct ProgramResult {
  int exit_code = -1;  // 128 + the signal's number if one ended it; 124: it hung
  std::string text;    // what it printed, errors included
};

// environment: "NAME=value ..." in front of the command.
ProgramResult run_program(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                          const std::string& environment = "");

}  // namespace pssmlt::test
