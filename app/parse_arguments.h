// CLI11's parsing with this program's errors.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "core/base/error.h"

namespace pssmlt {

// False if help was asked for and printed. Throws Error on bad usage.
inline bool parse_arguments(CLI::App& app, Arguments arguments) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return false;
  } catch (const CLI::ParseError& error) {
    throw Error(std::string(error.what()) + "\nSee: " + app.get_name() + " --help");
  }
  return true;
}

}  // namespace pssmlt
