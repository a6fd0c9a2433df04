// Requests byte for byte, and replies as they come.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace pssmlt {

// Long enough for any machine; tests that wait so long have failed.
inline constexpr int patience = 20000;  // [ms]

class RawClient {
 public:
  explicit RawClient(int port, int receive_buffer = 0) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawClient() { close(fd_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool connected() const { return connected_; }
  // False when the server has closed the connection.
  bool send_text(const std::string& text) const {
    for (size_t at = 0; at < text.size();) {
      const ssize_t sent = send(fd_, text.data() + at, text.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) return false;
      at += static_cast<size_t>(sent);
    }
    return true;
  }
  // What comes until `wanted` stands in it, the connection ends, or patience does.
  const std::string& read_until(const std::string& wanted) {
    char buffer[4096];
    while (wanted.empty() || text_.find(wanted) == std::string::npos) {
      pollfd state = {fd_, POLLIN, 0};
      if (poll(&state, 1, patience) <= 0) {
        timed_out_ = true;
        break;
      }
      const ssize_t count = recv(fd_, buffer, sizeof buffer, 0);
      if (count <= 0) break;
      text_.append(buffer, static_cast<size_t>(count));
    }
    return text_;
  }
  const std::string& read_all() { return read_until(""); }
  bool timed_out() const { return timed_out_; }

 private:
  int fd_;
  bool connected_ = false, timed_out_ = false;
  std::string text_;
};

// The reply to one request; "" if there is none.
inline std::string ask(int port, const std::string& request) {
  RawClient client(port);
  client.send_text(request);
  const std::string reply = client.read_all();
  EXPECT_FALSE(client.timed_out()) << request.substr(0, 200);
  return reply;
}

inline int status_of(const std::string& reply) {
  return reply.starts_with("HTTP/1.1 ") ? std::stoi(reply.substr(9, 3)) : 0;
}

inline std::string body_of(const std::string& reply) {
  const size_t end = reply.find("\r\n\r\n");
  return end == std::string::npos ? "" : reply.substr(end + 4);
}

inline std::string host_line(int port) {
  return "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
}

// A request line and our Host; `more`: further header lines.
inline std::string request(int port, const std::string& line, const std::string& more = "") {
  return line + " HTTP/1.1\r\n" + host_line(port) + more + "\r\n";
}

inline std::string origin_line(int port) {
  return "Origin: http://127.0.0.1:" + std::to_string(port) + "\r\n";
}

// The token that a page is given.
inline std::string token_of(int port) {
  RawClient page(port);
  page.send_text(request(port, "GET /events"));
  const std::string text = page.read_until("\"}\n\n");
  const size_t at = text.find("\"token\":\"");
  return at == std::string::npos ? "" : text.substr(at + 9, 32);
}

inline std::string stop_request(int port, const std::string& token) {
  return request(port, "POST /stop",
                 origin_line(port) + "Pssmlt-Token: " + token + "\r\nContent-Length: 0\r\n");
}

}  // namespace pssmlt
