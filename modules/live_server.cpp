// HTTP through cpp-httplib, which parses requests and writes replies. Connections, their limits and
// their ends are decided here: the library's own would wait for slow clients when it stops, and
// have no bound on the size and the time of a request.
#include <httplib.h>
#include <poll.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <list>
#include <thread>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/net/http_server.h"
#include "core/net/socket.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Threads that serve give way to those that render.
constexpr int niceness = 10;
constexpr double linger_seconds = 0.5;  // for a client to take a reply to a request half read [s]

// A connection's bytes, with limits.
class Connection final : public httplib::Stream {
 public:
  Connection(int socket, const WakeUp& wake, const HttpLimits& limits)
      : socket_(socket),
        wake_(wake),
        limits_(limits),
        read_until_(deadline_after(limits.request_seconds)),
        write_until_(read_until_ + (deadline_after(limits.reply_seconds) - NetClock::now())) {}

  bool is_readable() const override { return true; }
  // False when the client has gone. Only one that is read to without end has to keep its side open.
  bool is_writable() const override {
    pollfd state = {socket_.get(), static_cast<short>(endless_ ? POLLRDHUP : 0), 0};
    const int ready = poll(&state, 1, 0);
    return ready == 0 || (ready < 0 && errno == EINTR);
  }
  ssize_t read(char* to, size_t size) override {
    if (at_ == filled_ && !fill()) return -1;
    const size_t count = std::min(size, filled_ - at_);
    std::memcpy(to, buffer_.data() + at_, count);
    at_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* data, size_t size) override {
    answered_ = true;
    const bool sent = send_all(socket_.get(), data, size, wake_, limits_.stall_seconds,
                               endless_ ? NetClock::time_point::max() : write_until_);
    return sent ? static_cast<ssize_t>(size) : -1;
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "", port = 0; }
  socket_t socket() const override { return socket_.get(); }

  void make_endless() { endless_ = true; }

  void refuse(const char* status) {
    if (answered_) return;
    const std::string reply =
        std::string("HTTP/1.1 ") + status + "\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
    write(reply.data(), reply.size());
  }
  bool too_large() const { return taken_ >= limits_.request_bytes; }

  // Closing with unread bytes would reset the connection and lose the reply under way.
  void linger() {
    shutdown(socket_.get(), SHUT_WR);
    const auto until = deadline_after(linger_seconds);
    while (wait_for_socket(socket_.get(), POLLIN, wake_, until) &&
           recv(socket_.get(), buffer_.data(), buffer_.size(), MSG_DONTWAIT) > 0) {
    }
  }

 private:
  bool fill() {
    if (too_large() || !wait_for_socket(socket_.get(), POLLIN, wake_, read_until_)) return false;
    const size_t most = std::min(buffer_.size(), limits_.request_bytes - taken_);
    const ssize_t count = recv(socket_.get(), buffer_.data(), most, 0);
    if (count <= 0) return false;
    at_ = 0;
    filled_ = static_cast<size_t>(count);
    taken_ += filled_;
    return true;
  }

  Descriptor socket_;
  const WakeUp& wake_;
  const HttpLimits& limits_;
  NetClock::time_point read_until_, write_until_;
  std::array<char, 4096> buffer_;
  size_t at_ = 0, filled_ = 0, taken_ = 0;
  bool answered_ = false, endless_ = false;
};

// What the library's callbacks cannot be given: this thread's connection, and whether it is one too
// many.
thread_local Connection* current_connection = nullptr;
thread_local bool one_too_many = false;

// A thread a connection.
class ConnectionThreads final : public httplib::TaskQueue {
 public:
  explicit ConnectionThreads(int limit) : limit_(static_cast<size_t>(limit)) {}
  void enqueue(std::function<void()> serve) override {
    threads_.remove_if([](Served& s) {
      if (s.done->load()) s.thread.join();
      return !s.thread.joinable();
    });
    try {
      if (threads_.size() < limit_) return start(serve);
    } catch (const std::system_error&) {  // no more threads
    }
    one_too_many = true;
    serve();
    one_too_many = false;
  }
  void shutdown() override {
    for (Served& s : threads_) s.thread.join();
    threads_.clear();
  }

 private:
  struct Served {
    std::shared_ptr<std::atomic<bool>> done = std::make_shared<std::atomic<bool>>(false);
    std::thread thread;
  };
  void start(const std::function<void()>& serve) {
    Served served;
    served.thread = std::thread([serve, done = served.done] {
      setpriority(PRIO_PROCESS, 0, niceness);  // of this thread alone
      serve();
      done->store(true);
    });
    threads_.push_back(std::move(served));
  }
  size_t limit_;
  std::list<Served> threads_;
};

// The library's server with connections of ours.
class Listener final : public httplib::Server {
 public:
  Listener(const HttpLimits& limits, const WakeUp& wake) : limits_(limits), wake_(wake) {}

 private:
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, wake_, limits_);
    if (one_too_many) {
      connection.refuse("503 Service Unavailable");
      return false;
    }
    current_connection = &connection;
    try {
      bool closed = false;
      // Before the request is routed: no parts of replies (their sizes add up), no compression.
      process_request(connection, true, closed, [](httplib::Request& request) {
        request.ranges.clear();
        request.headers.erase("Accept-Encoding");
      });
      if (connection.too_large()) connection.refuse("431 Request Header Fields Too Large");
    } catch (const std::exception&) {
      connection.refuse("500 Internal Server Error");
    }
    current_connection = nullptr;
    connection.linger();
    return true;
  }
  const HttpLimits& limits_;
  const WakeUp& wake_;
};

HttpRequest request_of(const httplib::Request& from) {
  HttpRequest request{from.method, from.target, {}};
  for (const auto& [name, value] : from.headers) {
    std::string lower = name;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    request.headers.emplace_back(std::move(lower), value);
  }
  return request;
}

void send_stream(const HttpReply& reply, httplib::Response& response) {
  current_connection->make_endless();
  const Connection* connection = current_connection;
  const auto more = [next = reply.stream, connection](size_t, httplib::DataSink& sink) {
    std::string out;
    if (!connection->is_writable() || !next(out)) return false;
    return out.empty() || sink.write(out.data(), out.size());
  };
  response.set_content_provider(reply.type, more);
}

void fill_response(const HttpReply& reply, httplib::Response& response) {
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) response.set_header(name, value);
  if (reply.stream) return send_stream(reply, response);
  if (!reply.body || reply.body->empty()) return response.set_content("", reply.type);
  const auto body = reply.body;  // not copied
  response.set_content_provider(body->size(), reply.type,
                                [body](size_t offset, size_t length, httplib::DataSink& sink) {
                                  return sink.write(body->data() + offset, length);
                                });
}

class Server final : public HttpServer {
 public:
  Server(const std::string& address, int port, const HttpLimits& limits, HttpHandler handler)
      : limits_(limits), listener_(limits_, wake_) {
    configure(std::move(handler));
    listen(address, port);
    thread_ = std::thread([this] {
      if (!listener_.listen_after_bind() && !closing_) log_warning("the live server has ended");
      ended_ = true;
    });
    // Its stop() does nothing before that.
    while (!listener_.is_running() && !ended_) std::this_thread::yield();
  }
  ~Server() override {
    closing_ = true;
    wake_.ring();
    listener_.stop();
    thread_.join();
  }
  int port() const override { return port_; }

 private:
  void configure(HttpHandler handler) {
    // The library's default shares the port with other processes.
    listener_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    listener_.new_task_queue = [this] { return new ConnectionThreads(limits_.connections); };
    // Not the library's own routes: they match regular expressions against whatever clients send.
    listener_.set_pre_routing_handler(
        [handler = std::move(handler)](const httplib::Request& request,
                                       httplib::Response& response) {
          fill_response(handler(request_of(request)), response);
          return httplib::Server::HandlerResponse::Handled;
        });
    listener_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                       std::exception_ptr) { response.status = 500; });
  }
  void listen(const std::string& address, int port) {
    listener_.set_address_family(address.find(':') == std::string::npos ? AF_INET : AF_INET6);
    errno = 0;
    const bool bound = port != 0 ? listener_.bind_to_port(address, port)
                                 : (port = listener_.bind_to_any_port(address)) > 0;
    if (!bound) {
      const std::string why = errno != 0 ? std::strerror(errno) : "it is not possible";
      throw Error("cannot listen at " + address + ", port " + std::to_string(port) + ": " + why);
    }
    port_ = port;
  }

  HttpLimits limits_;
  WakeUp wake_;
  Listener listener_;
  std::atomic<bool> closing_{false}, ended_{false};
  int port_ = 0;
  std::thread thread_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_EXPORT void pssmlt_start_http_server(const std::string& address, int port,
                                            const pssmlt::HttpLimits& limits,
                                            pssmlt::HttpHandler handler,
                                            std::unique_ptr<pssmlt::HttpServer>& server) {
  server = std::make_unique<pssmlt::Server>(address, port, limits, std::move(handler));
}

static_assert(std::is_same_v<decltype(pssmlt_start_http_server), pssmlt::StartHttpServer>);
