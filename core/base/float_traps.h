// Traps of floating point: in builds with PSSMLT_TRAPS an invalid operation, a division by zero or
// an overflow raises SIGFPE where it happens, on the threads that render and in tests. In all other
// builds these classes do nothing. docs/numerics.md lists what is left to trap, and why.
#pragma once

#ifdef PSSMLT_TRAPS
#include <cfenv>
#endif

namespace pssmlt {

#ifdef PSSMLT_TRAPS
inline constexpr int trapped_exceptions = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

// Enables or disables the traps on this thread; what was raised before is forgotten.
inline void set_float_traps(bool on) {
  feclearexcept(FE_ALL_EXCEPT);
  fedisableexcept(FE_ALL_EXCEPT);
  if (on) feenableexcept(trapped_exceptions);
}
// Whether this thread is one that traps; a handler may have disabled them for a while.
inline thread_local bool traps_floats = false;

// Traps on this thread while alive; `on` false: leaves everything as it is. Code that others call
// back (shapes, by Embree) passes traps_floats.
class FloatTraps {
 public:
  explicit FloatTraps(bool on = true) : before_(traps_floats), enabled_(fegetexcept() != 0) {
    if (on) set_float_traps(traps_floats = true);
  }
  ~FloatTraps() {
    traps_floats = before_;
    set_float_traps(enabled_);
  }
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;

 private:
  bool before_, enabled_;
};

// Disables them around code of others that raises exceptions by design: Embree, image libraries.
class NoFloatTraps {
 public:
  NoFloatTraps() { set_float_traps(false); }
  ~NoFloatTraps() { set_float_traps(traps_floats); }
  NoFloatTraps(const NoFloatTraps&) = delete;
  NoFloatTraps& operator=(const NoFloatTraps&) = delete;
};
#else
inline constexpr bool traps_floats = false;
class FloatTraps {
 public:
  explicit FloatTraps(bool = true) {}
  ~FloatTraps() {}
};
class NoFloatTraps {
 public:
  NoFloatTraps() {}
  ~NoFloatTraps() {}
};
#endif

}  // namespace pssmlt
