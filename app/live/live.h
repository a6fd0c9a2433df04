// A page that follows a run in browsers: what publish() gets is sent to every open page. Nothing
// here waits for a browser; one that is slow gets the newest state when it is ready for it.
// docs/live.md has the routes.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/page_file.h"

namespace pssmlt {

struct LiveSettings {
  std::string address = "127.0.0.1";  // numeric, or localhost
  int port = 0;                       // 0: any that is free
  bool allow_public = false;          // address may be another than loopback
  std::vector<PageFile> files;        // besides images and events only files are served
  // Content-Security-Policy of all replies: what the page may load and from where.
  std::string content_policy =
      "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
};

class LiveServer {
 public:
  // Listens. `stop` becomes true when somebody presses the page's stop button; it has to live as
  // long as the server. Throws Error if the address is not allowed or the port not free.
  LiveServer(LiveSettings settings, std::atomic<bool>& stop);
  // Closes all connections at once, whatever their state.
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  int port() const;
  std::string url() const;  // "http://127.0.0.1:40123/"

  // A file more, or instead of the one at this path. May be called from any thread, as the others
  // below.
  void publish_file(PageFile file);
  // The same, read anew for every request, on a thread of the server: nothing of it is kept.
  void publish_file(const std::string& path, const std::string& type,
                    std::function<std::string()> read);
  // The event "status" with these data.
  void publish(const nlohmann::json& status);
  // /image/<id> is this from now on, and the event "image" says so. id: letters, digits, -, _,
  // dots.
  void publish_image(const std::string& id, std::string bytes);
  // The same, encoded when first asked for, on a thread of the server, once.
  void publish_image(const std::string& id, std::function<std::string()> encode);

  // Whether a page is open.
  bool watched() const;
  // Waits until no page is open (a page closes its stream when a status has "final": true and it
  // has what it shows), `seconds` at most.
  void drain(double seconds) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pssmlt
