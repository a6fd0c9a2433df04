// pssmlt: a light transport renderer in which any integrator runs under any sampler.
#include <cstdio>
#include <map>
#include <new>

#include "app/commands.h"
#include "core/base/error.h"

namespace {

using pssmlt::Arguments;

constexpr const char* usage =
    "usage: pssmlt [render] SCENE [options]     render a scene (pssmlt render --help)\n"
    "       pssmlt compare SCENE... [options]   error against run time of several techniques\n"
    "       pssmlt info SCENE                   what a scene contains\n"
    "       pssmlt error PICTURE REFERENCE      how far a picture is from a reference\n"
    "       pssmlt merge A B ... -o C           average independent renders of one picture\n"
    "       pssmlt convert OLD NEW              a scene as one file in today's format\n"
    "       pssmlt stress [options]             extreme scenes with known pictures, all "
    "techniques\n"
    "       pssmlt plugins [KIND [NAME]]        reference of the plugins' parameters\n"
    "       pssmlt --version                    versions and processor features\n";

int run(Arguments arguments) {
  if (arguments.empty()) {
    std::fputs(usage, stderr);
    return 2;
  }
  const std::string first = arguments.front();
  if (first == "--help" || first == "-h" || first == "help") {
    std::fputs(usage, stdout);
    return 0;
  }
  if (first == "--version" || first == "version") return pssmlt::run_version();
  static const std::map<std::string, int (*)(const Arguments&)> commands = {
      {"render", pssmlt::run_render},   {"compare", pssmlt::run_compare},
      {"plugins", pssmlt::run_plugins}, {"info", pssmlt::run_info},
      {"error", pssmlt::run_error},     {"merge", pssmlt::run_merge},
      {"convert", pssmlt::run_convert}, {"stress", pssmlt::run_stress}};
  const auto command = commands.find(first);
  if (command == commands.end()) return pssmlt::run_render(arguments);
  arguments.erase(arguments.begin());
  return command->second(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(Arguments(argv + 1, argv + argc));
  } catch (const pssmlt::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory\n", stderr);
    return 1;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "error: %s\n", failure.what());
    return 1;
  }
}
