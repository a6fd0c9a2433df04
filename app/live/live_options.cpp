#include "app/live/live_options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/base/log.h"

namespace pssmlt {

CLI::Option* add_live_options(CLI::App& app, LiveOptions& o, const std::string& shown) {
  const auto live =
      app.add_flag("--live", o.live, "serve a page that shows " + shown + " while it runs");
  app.add_option("--port", o.port, "port of the page (any that is free)")
      ->check(CLI::Range(1, 65535))
      ->needs(live);
  app.add_option("--live-address", o.address, "numeric address to serve the page at (127.0.0.1)")
      ->needs(live);
  app.add_flag("--live-public", o.allow_public,
               "allow an address that other machines reach; who reaches it may watch and stop")
      ->needs(live);
  return live;
}

std::unique_ptr<LiveServer> serve(const LiveOptions& options, std::vector<PageFile> files,
                                  const nlohmann::json& status, std::atomic<bool>& stop) {
  if (!options.live) return nullptr;
  LiveSettings settings;
  settings.address = options.address;
  settings.port = options.port;
  settings.allow_public = options.allow_public;
  settings.files = std::move(files);
  auto server = std::make_unique<LiveServer>(std::move(settings), stop);
  server->publish(status);
  log_info("live: " + server->url());
  return server;
}

}  // namespace pssmlt
