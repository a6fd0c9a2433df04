// Runs the built command in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace pssmlt::test {

namespace fs = std::filesystem;

struct ProgramResult {
  int exit_code = -1;  // 128 + the signal's number if one ended it; 124: it hung
  std::string text;    // what it printed, errors included
};

// environment: "NAME=value ..." in front of the command.
ProgramResult run_program(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                          const std::string& environment = "");

}  // namespace pssmlt::test
