#include "tests/bad_input/run_program.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <sys/wait.h>

namespace pssmlt::test {
namespace {

// In single quotes, as a shell takes it whatever it holds.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                          const std::string& environment) {
  // The output lies beside the folder, so that the folder shows what the program wrote. The limit
  // ends a hang; it is no measurement.
  const std::string output = folder.path().string() + ".log";
  std::string command = "cd " + quoted(folder.path().string()) + " && " + environment +
                        " timeout -k 5 120 " + quoted(PSSMLT_BINARY);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  const int status = std::system((command + " >" + quoted(output) + " 2>&1 </dev/null").c_str());
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ostringstream text;
  text << std::ifstream(output, std::ios::binary).rdbuf();
  result.text = text.str();
  fs::remove(output);
  return result;
}

}  // namespace pssmlt::test
