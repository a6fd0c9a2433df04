#include "app/stress/process.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "core/base/error.h"

namespace pssmlt::stress {
namespace {
namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

WorkFolder::WorkFolder() {
  std::string pattern = (fs::temp_directory_path() / "pssmlt-stress-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw Failure("cannot make the folder " + pattern);
  path_ = pattern;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void WorkFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

ProcessResult run_script(const WorkFolder& folder, const std::string& program,
                         const std::string& script, double seconds) {
  folder.write("script.sh", "PSSMLT=" + quoted(program) + "\n" + script + "\n");
  const std::string command = "cd " + quoted(folder.path().string()) + " && timeout -k 5 " +
                              std::to_string(seconds) + " sh script.sh 2>&1 </dev/null";
  ProcessResult result;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw Failure("cannot run sh");
  std::array<char, 4096> buffer;
  for (size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    result.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace pssmlt::stress
