#include "app/compare/machine.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "app/compare/text.h"
#include "app/version.h"

namespace pssmlt::compare {
namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const size_t colon = line.find(':');
    if (colon != std::string::npos && line.starts_with("model name")) {
      return trimmed(line.substr(colon + 1));
    }
  }
  return "unknown";
}

}  // namespace

nlohmann::json machine_json() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return {{"processor", processor_name()},
          {"threads", std::thread::hardware_concurrency()},
          {"memory_bytes", pages * static_cast<double>(sysconf(_SC_PAGESIZE))}};
}

nlohmann::json program_json() {
  nlohmann::json libraries = nlohmann::json::object();
  for (const auto& [name, version] : library_versions()) libraries[name] = version;
  return {{"version", PSSMLT_VERSION}, {"libraries", libraries}};
}

std::string time_stamp() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace pssmlt::compare
