// Sockets that never block beyond a deadline and can be told to give up.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pssmlt {

using NetClock = std::chrono::steady_clock;

// Now + seconds.
NetClock::time_point deadline_after(double seconds);

// An open file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) reset(other.release());
    return *this;
  }
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  int release();
  void reset(int fd = -1);

 private:
  int fd_;
};

// Ends all waits of other threads, now and later.
class WakeUp {
 public:
  WakeUp();  // throws Failure
  void ring() const;
  int descriptor() const { return event_.get(); }

 private:
  Descriptor event_;
};

// Waits until poll() reports one of `events` (or an error) for the socket. False: the deadline has
// passed or the bell was rung.
bool wait_for_socket(int socket, short events, const WakeUp& wake, NetClock::time_point deadline);

// Sends all; false: the peer is gone, took nothing for `stall_seconds`, the deadline has passed, or
// the bell was rung. No signal.
bool send_all(int socket, const char* data, size_t size, const WakeUp& wake, double stall_seconds,
              NetClock::time_point deadline);

// A host and a port as given by a user: "host", "host:port", "[::1]:port".
struct HostPort {
  std::string host;
  int port = 0;
};
// Throws Error with `what` (the option's name) if the text is neither.
HostPort parse_host_port(const std::string& text, int default_port, const std::string& what);

// Connects by TCP; an invalid descriptor if that fails, `why` then says how.
Descriptor connect_to(const HostPort& to, const WakeUp& wake, double seconds, std::string& why);

}  // namespace pssmlt
