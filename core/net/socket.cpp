#include "core/net/socket.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>

#include "core/base/error.h"

namespace pssmlt {
namespace {

// One address; the reason in errno.
Descriptor connect_address(const addrinfo& address, const WakeUp& wake,
                           NetClock::time_point deadline) {
  Descriptor made(socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                         address.ai_protocol));
  if (!made.valid()) return made;
  if (connect(made.get(), address.ai_addr, address.ai_addrlen) == 0) return made;
  if (errno != EINPROGRESS) return Descriptor();
  if (!wait_for_socket(made.get(), POLLOUT, wake, deadline)) {
    errno = ETIMEDOUT;
    return Descriptor();
  }
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(made.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error == 0) return made;
  errno = error;
  return Descriptor();
}

}  // namespace

NetClock::time_point deadline_after(double seconds) {
  return NetClock::now() +
         std::chrono::duration_cast<NetClock::duration>(std::chrono::duration<double>(seconds));
}

int Descriptor::release() {
  const int fd = fd_;
  fd_ = -1;
  return fd;
}

void Descriptor::reset(int fd) {
  if (fd_ >= 0) close(fd_);
  fd_ = fd;
}

WakeUp::WakeUp() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!event_.valid()) throw Failure(std::string("eventfd: ") + std::strerror(errno));
}

void WakeUp::ring() const {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(event_.get(), &one, sizeof one);
}

bool wait_for_socket(int socket, short events, const WakeUp& wake, NetClock::time_point deadline) {
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - NetClock::now()).count();
    pollfd both[2] = {{socket, events, 0}, {wake.descriptor(), POLLIN, 0}};
    const int ready = poll(both, 2, static_cast<int>(std::clamp<int64_t>(left, 0, 1 << 30)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || both[1].revents != 0) return false;
    return true;
  }
}

bool send_all(int socket, const char* data, size_t size, const WakeUp& wake, double stall_seconds,
              NetClock::time_point deadline) {
  while (size > 0) {
    const ssize_t sent = send(socket, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      data += sent;
      size -= static_cast<size_t>(sent);
    } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      return false;
    } else if (!wait_for_socket(socket, POLLOUT, wake,
                                std::min(deadline, deadline_after(stall_seconds)))) {
      return false;
    }
  }
  return true;
}

HostPort parse_host_port(const std::string& text, int default_port, const std::string& what) {
  HostPort result{text, default_port};
  std::string port;
  const size_t colon = text.rfind(':');
  if (text.starts_with('[')) {
    const size_t end = text.find(']');
    const bool bare = end + 1 == text.size();
    if (end != std::string::npos && (bare || end + 1 == colon)) {
      result.host = text.substr(1, end - 1);
      if (!bare) port = text.substr(colon + 1);
    } else {
      result.host.clear();
    }
  } else if (colon != std::string::npos) {
    result.host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  bool fine =
      !result.host.empty() && (text.starts_with('[') || result.host.find(':') == std::string::npos);
  if (!port.empty() || (fine && text.ends_with(':'))) {
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), result.port);
    fine = fine && error == std::errc() && end == port.data() + port.size() && result.port > 0 &&
           result.port < 65536;
  }
  if (!fine) {
    throw Error(what + ": \"" + text + "\" is not an address like localhost:" +
                std::to_string(default_port) + " or [::1]:" + std::to_string(default_port));
  }
  return result;
}

Descriptor connect_to(const HostPort& to, const WakeUp& wake, double seconds, std::string& why) {
  const NetClock::time_point deadline = deadline_after(seconds);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failed = getaddrinfo(to.host.c_str(), std::to_string(to.port).c_str(), &hints, &list);
  if (failed != 0) {
    why = gai_strerror(failed);
    return Descriptor();
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(list, freeaddrinfo);
  for (const addrinfo* a = list; a != nullptr; a = a->ai_next) {
    Descriptor made = connect_address(*a, wake, deadline);
    if (made.valid()) return made;
    why = std::strerror(errno);
  }
  return Descriptor();
}

}  // namespace pssmlt
