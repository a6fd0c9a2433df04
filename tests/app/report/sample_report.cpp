// sample_report FOLDER [name=number ...]: writes a report of invented data, for tests of the page
// and for work on it. Names are those of sample::Settings.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <map>
#include <string>

#include "tests/app/report/sample_data.h"

int main(int argc, char** argv) {
  pssmlt::sample::Settings s;
  const std::map<std::string, int*> numbers = {
      {"techniques", &s.techniques}, {"scenes", &s.scenes}, {"runs", &s.runs},
      {"snapshots", &s.snapshots},   {"width", &s.width},   {"height", &s.height}};
  const std::map<std::string, bool*> flags = {{"partial", &s.partial},
                                              {"biased", &s.biased},
                                              {"gaps", &s.gaps},
                                              {"hostile", &s.hostile},
                                              {"bare", &s.bare}};
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
    const std::string text = argument.substr(std::min(name.size() + 1, argument.size()));
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool read = error == std::errc() && end == text.data() + text.size();
    if (read && numbers.contains(name)) {
      *numbers.at(name) = value;
    } else if (read && flags.contains(name)) {
      *flags.at(name) = value != 0;
    } else {
      std::fprintf(stderr, "unknown argument '%s'\n", argv[i]);
      return 2;
    }
  }
  if (argc < 2) {
    std::fprintf(stderr, "usage: sample_report FOLDER [name=number ...]\n");
    return 2;
  }
  pssmlt::sample::write_report(argv[1], s);
  return 0;
}
