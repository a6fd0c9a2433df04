// What `pssmlt stress` tests, as data: cases of the catalogue, the values that each is swept over,
// and oracles that say what the picture must be. Adding a case is one entry of a file in
// app/stress/catalogue.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pssmlt::stress {

// An integrator under a sampler; both empty for what no technique decides.
struct Pair {
  std::string integrator = {}, sampler = {};
  bool operator==(const Pair&) const = default;
};

enum class Verdict : uint8_t { pass, fail, cannot_see, undecided, not_run };
std::string_view to_string(Verdict verdict);

// What was found at one value of a case with one pair.
struct Outcome {
  Verdict verdict = Verdict::not_run;
  std::string reason = {};  // of all verdicts but pass; of pass: what was seen
  std::optional<double> deviation = {}, tolerance = {};  // relative, of what the oracle compares
  std::string meaning = {};                              // of the tolerance
  uint64_t dropped = 0;                        // samples that were not finite, or the like
  std::optional<double> relative_speed = {};   // rays a second over those of the polite scene
  std::optional<double> acceptance = {};       // of chains
  std::optional<uint64_t> longest_stuck = {};  // of chains [mutations]
  double seconds = 0.0;
};

// Every pixel is `factor`, a power of two, times that of the polite scene, bit for bit.
struct SameBits {
  double factor = 1.0;
};
// Block means are `factor` times those of the polite scene, rendered by the same pair. `rounding`:
// relative difference that is there by nature.
struct SameMeans {
  double factor = 1.0;
  double rounding = 1e-4;
};
// Luminance of the blocks of 16 x 16 pixels, row by row, or of the whole picture [W/(m^2 sr)].
struct Means {
  std::vector<double> values;
  double rounding = 2e-4;
};
// The mean luminance is at most this, and not negative.
struct AtMost {
  double most = 1.0;
};
// Loading ends with an error whose text holds this.
struct Refused {
  std::string message;
};
// Everything else: a function that says what it found.
struct ProbeContext {
  Pair pair;
  std::string program;  // the pssmlt command's file
  double false_alarm;   // that one comparison may use
  double seconds;       // that it should take at most [s]
  int threads;
};
struct Probe {
  std::function<Outcome(const ProbeContext&)> run;
};
using Oracle = std::variant<SameBits, SameMeans, Means, AtMost, Refused, Probe>;

// One value of the sweep.
struct Point {
  std::string value;                   // as the table shows it
  std::function<std::string()> scene;  // text; empty for probes
  Oracle oracle = Probe{};
  std::vector<std::string> set = {};       // as --set of the command
  std::vector<std::string> warnings = {};  // texts that the log has to hold
  std::string classes = {};                // instead of the case's
  // Lobes are so narrow that only integrators that follow them to the light see it: one that draws
  // a point on the light, or on the lens, finds it once in 1 / width^2 draws.
  bool narrow = false;
  // The picture shows so little of the scene that light traced from the lamps does not land in it.
  bool aimed = false;
  std::optional<double> demand = {};  // instead of the case's
  // Some samples must be dropped, for one of these causes. Empty: none may be.
  std::vector<std::string> drops = {};
  std::string culprit = {};  // the plugin that is to be named for them
};

// What a case is run with: every integrator under every sampler, every sampler (probes that bring
// their own target), or once.
enum class Over : uint8_t { pairs, samplers, once };

struct Case {
  int group = 0;                   // of the catalogue
  std::string name = {};           // "scale-bits"
  std::string about = {};          // what is swept and what must hold, one line
  std::vector<Point> points = {};  // the extremes first
  // Speeds are relative to this scene, and so are pictures. Empty: the last point's.
  std::function<std::string()> polite = {};
  std::string classes = "L.*E";  // of the light that the oracles count, a path expression
  int max_depth = 5;             // bounces
  double demand = 0.1;           // relative; a tolerance above it decides nothing
  Over over = Over::pairs;
  int bootstrap = 8192;    // samples of chains, where a sampler has such a parameter
  int least_samples = 32;  // a pixel, of comparisons by statistics
  int samples = 16;        // samples a pixel of comparisons bit by bit
};

}  // namespace pssmlt::stress
