// pssmlt --version: what this program was built with and what the processor can do.
#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <spdlog/version.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <boost/version.hpp>
#include <glm/detail/setup.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <thread>

#include "app/commands.h"
#include "app/version.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

std::string processor_features() {
  std::string text;
#if defined(__x86_64__)
  const auto add = [&text](bool present, const char* name) {
    if (present) text += (text.empty() ? "" : " ") + std::string(name);
  };
  add(__builtin_cpu_supports("sse4.2") != 0, "sse4.2");
  add(__builtin_cpu_supports("avx") != 0, "avx");
  add(__builtin_cpu_supports("fma") != 0, "fma");
  add(__builtin_cpu_supports("avx2") != 0, "avx2");
  add(__builtin_cpu_supports("avx512f") != 0, "avx512f");
#elif defined(__aarch64__)
  text = "neon";
#endif
  return text.empty() ? "baseline" : text;
}

std::string dotted(int version) {
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"Embree", RTC_VERSION_STRING},
          {"oneTBB", fmt::format("{} (loaded: {})", TBB_VERSION_STRING, TBB_runtime_version())},
          {"fmt", dotted(FMT_VERSION)},
          {"spdlog", dotted(SPDLOG_VERSION)},
          {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                        NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
          {"CLI11", CLI11_VERSION},
          {"GLM", fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR,
                              GLM_VERSION_PATCH, GLM_VERSION_REVISION)},
          {"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
                                BOOST_VERSION % 100)}};
}

int run_version() {
  std::printf("pssmlt %s (plugin ABI %d, compiler %s)\n", PSSMLT_VERSION, abi_version, __VERSION__);
  std::string libraries;
  for (const auto& [name, version] : library_versions()) {
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  }
  std::printf("%s\n", libraries.c_str());
  std::printf("processor: %s, %u threads\n", processor_features().c_str(),
              std::thread::hardware_concurrency());
  return 0;
}

}  // namespace pssmlt
