// The options of commands that serve a page while they run, and the server that they ask for.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/live/live.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pssmlt {

struct LiveOptions {
  bool live = false;
  int port = 0;  // 0: any that is free
  std::string address = "127.0.0.1";
  bool allow_public = false;
};

// Declares --live, --port, --live-address and --live-public; returns the first. `shown`: what the
// page shows, for the help.
CLI::Option* add_live_options(CLI::App& app, LiveOptions& options, const std::string& shown);

// A server of these files with this status, its address printed; null without --live. `stop`
// becomes true when the page's stop button is pressed. Throws Error (an address that cannot be
// had).
std::unique_ptr<LiveServer> serve(const LiveOptions& options, std::vector<PageFile> files,
                                  const nlohmann::json& status, std::atomic<bool>& stop);

}  // namespace pssmlt
