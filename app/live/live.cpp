#include "app/live/live.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "app/live/guard.h"
#include "app/live/live_state.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/net/http_server.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace {

constexpr std::string_view image_prefix = "/image/";

// The number after "after=" in a query, 0 without.
uint64_t version_after(std::string_view query) {
  constexpr std::string_view key = "after=";
  uint64_t version = 0;
  if (query.starts_with(key)) {
    std::from_chars(query.data() + key.size(), query.data() + query.size(), version);
  }
  return version;
}

std::string checked_address(const LiveSettings& settings) {
  std::string address = numeric_address(settings.address);
  if (!is_loopback(address) && !settings.allow_public) {
    throw Error("live address " + address +
                " is not loopback: whoever reaches it could watch and stop the run; "
                "--live-public allows that");
  }
  return address;
}

HttpReply not_allowed(const std::string& allowed) {
  HttpReply reply = plain_reply(405, "this is for " + allowed);
  reply.headers.emplace_back("Allow", allowed);
  return reply;
}

}  // namespace

struct LiveServer::Impl {
  Impl(LiveSettings s, std::atomic<bool>& stop);
  void publish(PageFile file);
  HttpReply answer(const HttpRequest& request);
  HttpReply route(const HttpRequest& request, const std::string& path, const std::string& query);
  HttpReply send_image(const std::string& id, uint64_t after);
  HttpReply stop_run(const HttpRequest& request);

  LiveSettings settings;
  std::string address;
  std::atomic<bool>& stop;
  LiveState state;
  std::shared_ptr<const Guard> guard;  // made when the port is known
  std::atomic<bool> ready{false};      // guard is there
  std::unique_ptr<HttpServer> server;  // last: its threads use all the rest
};

LiveServer::Impl::Impl(LiveSettings s, std::atomic<bool>& stop_flag)
    : settings(std::move(s)), address(checked_address(settings)), stop(stop_flag) {
  for (PageFile& file : settings.files) publish(std::move(file));
  void* const symbol = Registry::instance().module("live_server", http_server_symbol);
  const auto start = reinterpret_cast<StartHttpServer*>(symbol);
  start(
      address, settings.port, HttpLimits{},
      [this](const HttpRequest& request) { return answer(request); }, server);
  guard = std::make_shared<const Guard>(address, server->port());
  ready = true;
}

void LiveServer::Impl::publish(PageFile file) {
  const auto text = std::make_shared<const std::string>(std::move(file.text));
  state.set_file(file.path, {file.type, [text] { return text; }});
}

HttpReply LiveServer::Impl::answer(const HttpRequest& request) {
  if (!ready) return plain_reply(503, "not yet");
  const size_t mark = std::min(request.target.find('?'), request.target.size());
  const std::string path = request.target.substr(0, mark);
  const std::string query = mark < request.target.size() ? request.target.substr(mark + 1) : "";
  std::optional<HttpReply> refused = guard->refuse(request);
  HttpReply reply = refused ? *refused : route(request, path, query);
  reply.headers.emplace_back("Cache-Control", "no-store");
  reply.headers.emplace_back("X-Content-Type-Options", "nosniff");
  reply.headers.emplace_back("X-Frame-Options", "DENY");
  reply.headers.emplace_back("Referrer-Policy", "same-origin");
  reply.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
  reply.headers.emplace_back("Content-Security-Policy", settings.content_policy);
  return reply;
}

HttpReply LiveServer::Impl::route(const HttpRequest& request, const std::string& path,
                                  const std::string& query) {
  const bool get = request.method == "GET", head = request.method == "HEAD";
  if (path == "/stop") return request.method == "POST" ? stop_run(request) : not_allowed("POST");
  const PublishedFile file = state.file(path);
  const bool known = path == "/events" || path.starts_with(image_prefix) || file.read;
  if (!known) return plain_reply(404, "there is nothing here");
  if (!get && !head) return not_allowed("GET, HEAD");
  HttpReply reply;
  if (path == "/events") {
    reply.type = "text/event-stream";
    if (get) reply.stream = state.make_stream(nlohmann::json{{"token", guard->token()}}.dump());
    return reply;
  }
  if (path.starts_with(image_prefix)) {
    return send_image(path.substr(image_prefix.size()), version_after(query));
  }
  reply.type = file.type;
  reply.body = file.read();
  return reply;
}

HttpReply LiveServer::Impl::send_image(const std::string& id, uint64_t after) {
  const std::shared_ptr<LiveImage> image = state.image(id);
  if (!image) return plain_reply(404, "there is no such image");
  HttpReply reply;
  reply.type = "application/octet-stream";
  reply.headers.emplace_back("Pssmlt-Version", std::to_string(image->version()));
  if (image->version() <= after) {
    reply.status = 204;
  } else {
    reply.body = image->bytes();
  }
  return reply;
}

HttpReply LiveServer::Impl::stop_run(const HttpRequest& request) {
  if (const auto refused = guard->refuse_change(request)) return *refused;
  if (!stop.exchange(true)) {
    log_info("stopped from the live page: finishing the round, then writing");
  }
  return plain_reply(202, "stopping");
}

LiveServer::LiveServer(LiveSettings settings, std::atomic<bool>& stop)
    : impl_(std::make_unique<Impl>(std::move(settings), stop)) {}

LiveServer::~LiveServer() {
  impl_->state.close();
  impl_->server.reset();
}

int LiveServer::port() const { return impl_->server->port(); }

std::string LiveServer::url() const {
  const bool v6 = impl_->address.find(':') != std::string::npos;
  const std::string host = v6 ? "[" + impl_->address + "]" : impl_->address;
  return "http://" + host + ":" + std::to_string(port()) + "/";
}

void LiveServer::publish_file(PageFile file) { impl_->publish(std::move(file)); }

void LiveServer::publish_file(const std::string& path, const std::string& type,
                              std::function<std::string()> read) {
  impl_->state.set_file(path, {type, [read = std::move(read)] {
                                 return std::make_shared<const std::string>(read());
                               }});
}

void LiveServer::publish(const nlohmann::json& status) {
  // Names of files need not be UTF-8.
  impl_->state.set_status(status.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void LiveServer::publish_image(const std::string& id, std::string bytes) {
  publish_image(id, [kept = std::move(bytes)] { return kept; });
}

void LiveServer::publish_image(const std::string& id, std::function<std::string()> encode) {
  impl_->state.set_image(id, std::move(encode));
}

bool LiveServer::watched() const { return impl_->state.streams() > 0; }

void LiveServer::drain(double seconds) const { impl_->state.wait_for_no_streams(seconds); }

}  // namespace pssmlt
