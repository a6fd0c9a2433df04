// Runs cases with pairs of integrators and samplers, the extremes first, within a budget of time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/stress/catalogue.h"
#include "app/stress/picture.h"

namespace pssmlt::stress {

// Probability that a run of the whole grid reports a failure where there is none.
inline constexpr double false_alarm_of_all = 1e-6;

struct RunnerOptions {
  std::vector<std::string> integrators, samplers;
  double seconds = 600.0;  // budget; the least that has to run is run even if it takes longer
  int threads = 0;
  uint64_t seed = 1;
  std::string program;  // the command's own file, for cases that need a process
  std::function<bool()> stop = [] { return false; };
  std::function<void(const std::string& what, size_t done, size_t all)> progress = {};
};

// One value of a case with one pair.
struct Entry {
  size_t of_case = 0, of_point = 0;
  Pair pair;
  Outcome outcome;
};

class Runner {
 public:
  Runner(const Cases& cases, RunnerOptions options);
  // Every entry of the grid; what the budget did not reach is `not_run`.
  std::vector<Entry> run();

 private:
  // What the polite scene of a case gives with a pair.
  struct Polite {
    Blocks blocks;
    Image image;  // after Case::samples, for comparisons bit by bit
    double rays_per_second = 0.0;
    double seconds = 0.0;  // that were allowed for it
  };
  std::vector<Entry> grid() const;
  std::vector<std::vector<size_t>> order(const std::vector<Entry>& entries) const;
  void run_entries(const std::vector<size_t>& which, bool always, std::vector<Entry>& entries);
  void decide_doubtful(std::vector<Entry>& entries);
  Outcome run_one(const Case& c, const Point& point, const Pair& pair, double seconds);
  Outcome load_and_judge(const Case& c, const Point& point, const Pair& pair, double seconds);
  Outcome judge(const Case& c, const Point& point, const Pair& pair, double seconds,
                Picture& picture);
  void judge_statistics(const Case& c, const Point& point, const Pair& pair, double seconds,
                        Picture& picture, Outcome& outcome);
  Job job(const Case& c, const Point& point, const Pair& pair, const std::string& scene) const;
  const Polite& polite(const Case& c, const Pair& pair, double seconds);
  double elapsed() const;

  const Cases& cases_;
  RunnerOptions options_;
  double start_ = 0.0, false_alarm_ = 0.0, seconds_a_run_ = 0.0;
  size_t done_ = 0;
  std::map<std::string, Polite> polite_;
};

}  // namespace pssmlt::stress
