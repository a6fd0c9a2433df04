// The progress line.
#pragma once

#include "core/render/render.h"

namespace pssmlt {

// On a terminal one line of standard error that is overwritten; elsewhere a line every 10 seconds.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool shown);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;
  void show(const Progress& progress);
  // Takes the line off the terminal.
  void clear();

 private:
  bool shown_, terminal_;
  bool dirty_ = false;
  double next_ = 0.0;  // of Progress::elapsed [s]
};

// "12.3 s", "4 m 05 s", "2 h 03 m".
std::string format_duration(double seconds);
// "12.3 M", "456 k": a count with a decimal prefix.
std::string format_count(double count);

}  // namespace pssmlt
