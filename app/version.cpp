// pssmlt --version: what this program was built with and what the processor can do.
#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <spdlog/version.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <glm/detail/setup.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <thread>

#include "app/commands.h"
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

}  // namespace

int run_version() {
  std::printf("pssmlt %s (plugin ABI %d, compiler %s)\n", PSSMLT_VERSION, abi_version, __VERSION__);
  std::printf("Embree %s, oneTBB %s (loaded: %s)\n", RTC_VERSION_STRING, TBB_VERSION_STRING,
              TBB_runtime_version());
  std::printf("fmt %d.%d.%d, spdlog %d.%d.%d, nlohmann-json %d.%d.%d, CLI11 %s, GLM %d.%d.%d.%d\n",
              FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, SPDLOG_VER_MAJOR,
              SPDLOG_VER_MINOR, SPDLOG_VER_PATCH, NLOHMANN_JSON_VERSION_MAJOR,
              NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, CLI11_VERSION,
              GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION);
  std::printf("processor: %s, %u threads\n", processor_features().c_str(),
              std::thread::hardware_concurrency());
  return 0;
}

}  // namespace pssmlt
