#include "app/live/tev.h"

#include <sys/resource.h>

#include <algorithm>

#include "app/live/tev_packet.h"
#include "core/base/log.h"

namespace pssmlt {
namespace {

constexpr int tile = 256;                // 786 kB, below the viewer's first buffer of 1 MiB
constexpr int niceness = 10;             // rendering goes first
constexpr double connect_seconds = 3.0;  // [s]

}  // namespace

TevDisplay::TevDisplay(const std::string& address, std::string name, const TevSettings& settings)
    : to_(parse_host_port(address, tev_port, "--display")),
      name_(std::move(name)),
      settings_(settings),
      thread_([this] { run(); }) {}

TevDisplay::~TevDisplay() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.ring();
  changed_.notify_all();
  thread_.join();
}

bool TevDisplay::ready() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && !given_up_ && NetClock::now() >= not_before_;
}

void TevDisplay::show(std::shared_ptr<const Image> image) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(image);
  }
  changed_.notify_all();
}

void TevDisplay::drain(double seconds) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [this] { return !busy_ && (!next_ || given_up_); });
}

void TevDisplay::run() {
  setpriority(PRIO_PROCESS, 0, niceness);  // of this thread alone
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closing_ || next_; });
    if (closing_) return;
    const std::shared_ptr<const Image> image = std::move(next_);
    next_.reset();
    busy_ = true;
    const bool try_it = !given_up_ && NetClock::now() >= not_before_;
    lock.unlock();
    const bool sent = try_it && send(*image);
    lock.lock();
    busy_ = false;
    if (try_it && !sent) {
      given_up_ = ++failures_ >= settings_.attempts;
      not_before_ = deadline_after(settings_.retry_seconds);
    } else if (sent) {
      failures_ = 0;
    }
    changed_.notify_all();
  }
}

bool TevDisplay::connect() {
  if (socket_.valid()) return true;
  width_ = height_ = 0;
  std::string why;
  socket_ = connect_to(to_, wake_, connect_seconds, why);
  if (!socket_.valid() && !warned_) {
    log_warning("no viewer at " + to_.host + ":" + std::to_string(to_.port) + ": " + why);
    warned_ = true;
  }
  return socket_.valid();
}

bool TevDisplay::send_packet(const std::string& packet) {
  const bool sent = send_all(socket_.get(), packet.data(), packet.size(), wake_,
                             settings_.stall_seconds, NetClock::time_point::max());
  if (!sent) socket_.reset();
  return sent;
}

bool TevDisplay::send(const Image& image) {
  if (!connect()) return false;
  if (width_ != image.width || height_ != image.height) {
    if (!send_packet(tev_create(name_, image.width, image.height))) return false;
    width_ = image.width;
    height_ = image.height;
  }
  for (int y = 0; y < image.height; y += tile) {
    for (int x = 0; x < image.width; x += tile) {
      const TevWindow window{x, y, std::min(tile, image.width - x),
                             std::min(tile, image.height - y)};
      if (!send_packet(tev_update(name_, image, window))) return false;
    }
  }
  return true;
}

}  // namespace pssmlt
