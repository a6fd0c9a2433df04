// A viewer that speaks tev's protocol, written from its description: it takes packets and keeps the
// pictures they make.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <condition_variable>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/image/image.h"

namespace pssmlt {

// Fields of one packet, in order. A packet that ends early is a test failure.
class PacketReader {
 public:
  explicit PacketReader(const std::string& bytes) : bytes_(bytes) {}
  template <typename T>
  T number() {
    T value{};
    if (at_ + sizeof value > bytes_.size()) {
      ADD_FAILURE() << "the packet is too short";
    } else {
      std::memcpy(&value, bytes_.data() + at_, sizeof value);
    }
    at_ += sizeof value;
    return value;
  }
  std::string text() {
    const size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) {
      ADD_FAILURE() << "a text without end";
      return "";
    }
    const std::string found = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return found;
  }
  size_t left() const { return at_ < bytes_.size() ? bytes_.size() - at_ : 0; }

 private:
  const std::string& bytes_;
  size_t at_ = 0;
};

class FakeViewer {
 public:
  explicit FakeViewer(bool reads = true)
      : reads_(reads), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    const int small = 4096;
    if (!reads_) setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const plain = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(listener_, plain, size), 0);
    EXPECT_EQ(listen(listener_, 4), 0);
    getsockname(listener_, plain, &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeViewer() {
    shutdown(listener_, SHUT_RDWR);
    disconnect();
    thread_.join();
    close(listener_);
  }
  FakeViewer(const FakeViewer&) = delete;
  FakeViewer& operator=(const FakeViewer&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  // Ends the connection that there is.
  void disconnect() {
    const std::lock_guard lock(mutex_);
    if (connection_ >= 0) shutdown(connection_, SHUT_RDWR);
  }
  // The picture once so many floats of it have come, or what there is after 20 seconds.
  Image picture(const std::string& name, size_t floats) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(20), [&] { return floats_ >= floats; });
    return pictures_[name];
  }
  int connections() {
    const std::lock_guard lock(mutex_);
    return connections_;
  }
  bool wait_for_connections(int count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return connections_ >= count; });
  }
  std::vector<std::string> names() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> found;
    for (const auto& [name, picture] : pictures_) found.push_back(name);
    return found;
  }

 private:
  void serve() {
    for (int fd; (fd = accept(listener_, nullptr, nullptr)) >= 0;) {
      {
        const std::lock_guard lock(mutex_);
        connection_ = fd;
        ++connections_;
      }
      changed_.notify_all();
      if (reads_) {
        read_packets(fd);
      } else {
        pollfd gone = {fd, POLLRDHUP, 0};
        poll(&gone, 1, 20000);
      }
      const std::lock_guard lock(mutex_);
      connection_ = -1;
      close(fd);
    }
  }
  void read_packets(int fd) {
    std::string bytes;
    char buffer[65536];
    for (ssize_t n; (n = recv(fd, buffer, sizeof buffer, 0)) > 0;) {
      bytes.append(buffer, static_cast<size_t>(n));
      uint32_t length = 0;
      while (bytes.size() >= sizeof length) {
        std::memcpy(&length, bytes.data(), sizeof length);
        if (length < 6) {
          ADD_FAILURE() << "a packet of " << length << " bytes";
          return;
        }
        if (bytes.size() < length) break;
        take(bytes.substr(0, length));
        bytes.erase(0, length);
      }
    }
  }
  void take(const std::string& packet) {
    PacketReader read(packet);
    read.number<uint32_t>();
    const char type = read.number<char>();
    EXPECT_LE(read.number<char>(), 1);
    const std::string name = read.text();
    const std::lock_guard lock(mutex_);
    if (type == 4) {
      create(read, pictures_[name]);
    } else if (type == 6) {
      EXPECT_TRUE(pictures_.contains(name)) << name;
      update(read, pictures_[name]);
    } else {
      ADD_FAILURE() << "type " << int{type};
    }
    changed_.notify_all();
  }
  static void channel_names(PacketReader& read) {
    ASSERT_EQ(read.number<int32_t>(), 3);
    for (const char* name : {"R", "G", "B"}) EXPECT_EQ(read.text(), name);
  }
  static void create(PacketReader& read, Image& picture) {
    const auto width = read.number<int32_t>(), height = read.number<int32_t>();
    channel_names(read);
    EXPECT_EQ(read.left(), 0u);
    picture = Image(width, height, 3);
  }
  void update(PacketReader& read, Image& picture) {
    channel_names(read);
    const auto x0 = read.number<int32_t>(), y0 = read.number<int32_t>();
    const auto width = read.number<int32_t>(), height = read.number<int32_t>();
    int64_t offset[3], stride[3];
    for (int64_t& o : offset) o = read.number<int64_t>();
    for (int64_t& s : stride) s = read.number<int64_t>();
    ASSERT_TRUE(x0 >= 0 && y0 >= 0 && x0 + width <= picture.width && y0 + height <= picture.height);
    std::vector<float> data(read.left() / sizeof(float));
    for (float& f : data) f = read.number<float>();
    ASSERT_EQ(data.size(), static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int64_t from = offset[c] + (int64_t{y} * width + x) * stride[c];
          picture.pixel(x0 + x, y0 + y)[c] = data[static_cast<size_t>(from)];
        }
      }
    }
    floats_ += data.size();
  }

  bool reads_;
  int listener_, port_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  int connection_ = -1, connections_ = 0;
  size_t floats_ = 0;
  std::map<std::string, Image> pictures_;
  std::thread thread_;
};

}  // namespace pssmlt
