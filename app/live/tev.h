// The picture in the viewer tev while it renders.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/image/image.h"
#include "core/net/socket.h"

namespace pssmlt {

struct TevSettings {
  int attempts = 5;             // to connect, in a row, before giving up
  double retry_seconds = 3.0;   // between them [s]
  double stall_seconds = 10.0;  // in which the viewer takes nothing: the connection is given up [s]
};

// A thread of its own connects and sends. Pictures that come while it sends replace each other, the
// newest one goes next; a viewer that is missing is one warning.
class TevDisplay {
 public:
  // `address`: "host", "host:port"; throws Error if it is neither. `name`: the picture's in tev.
  TevDisplay(const std::string& address, std::string name, const TevSettings& settings = {});
  // Ends at once.
  ~TevDisplay();
  TevDisplay(const TevDisplay&) = delete;
  TevDisplay& operator=(const TevDisplay&) = delete;

  // Whether a picture would be sent now: the last one is through, the viewer not given up.
  bool ready() const;
  // Never waits. Three channels.
  void show(std::shared_ptr<const Image> image);
  // Waits until what was shown last is sent or will not be, `seconds` at most.
  void drain(double seconds) const;

 private:
  void run();
  bool send(const Image& image);
  bool connect();
  bool send_packet(const std::string& packet);

  HostPort to_;
  std::string name_;
  TevSettings settings_;
  WakeUp wake_;
  Descriptor socket_;           // of the thread
  int width_ = 0, height_ = 0;  // of the picture made in the viewer; 0: none
  int failures_ = 0;            // attempts in a row
  bool warned_ = false;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::shared_ptr<const Image> next_;
  bool busy_ = false, given_up_ = false, closing_ = false;
  NetClock::time_point not_before_{};  // the next attempt
  std::thread thread_;                 // last: uses all the rest
};

}  // namespace pssmlt
