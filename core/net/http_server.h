// What crosses the border to the module that speaks HTTP (module "live_server"). The module knows
// requests, replies and limits; which request is answered how is the handler's business.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pssmlt {

using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

// A request's head; bodies are never read.
struct HttpRequest {
  std::string method;   // "GET", ...
  std::string target;   // as it was sent, not decoded: path and query
  HttpHeaders headers;  // names in lower case
};

struct HttpReply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  HttpHeaders headers;
  std::shared_ptr<const std::string> body;  // may belong to many replies at a time
  // Instead of a body: appends to `out` what is to be sent next, waiting for it for a second at
  // most (nothing then); false ends the reply.
  std::function<bool(std::string& out)> stream;
};

// A connection serves one request.
struct HttpLimits {
  size_t request_bytes = 8192;   // of a request's head
  int connections = 32;          // at a time; further ones get status 503
  double request_seconds = 5.0;  // from the connection to the end of the head [s]
  double reply_seconds = 60.0;   // for a reply that is not a stream [s]
  double stall_seconds = 10.0;   // in which a client takes nothing [s]
};

class HttpServer {
 public:
  HttpServer() = default;
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  // Ends all connections, whatever their clients do, and waits for their threads.
  virtual ~HttpServer() = default;
  virtual int port() const = 0;
};

// Called on the connections' threads, several at a time. What it throws becomes status 500.
using HttpHandler = std::function<HttpReply(const HttpRequest&)>;

// `address`: a numeric address; port 0: any that is free. Throws Error if that cannot be listened
// at.
inline constexpr const char* http_server_symbol = "pssmlt_start_http_server";
using StartHttpServer = void(const std::string& address, int port, const HttpLimits& limits,
                             HttpHandler handler, std::unique_ptr<HttpServer>& server);

}  // namespace pssmlt
