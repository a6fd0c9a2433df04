// What watches a render: the live page, the viewer tev, both or neither.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/live/live_options.h"
#include "app/live/tev.h"
#include "core/render/render.h"

namespace pssmlt {

struct ViewOptions {
  LiveOptions page;
  std::string display;  // "host:port" of tev; "": none
};

class RenderView {
 public:
  // Starts what the options ask for and prints the page's address. `stop` becomes true when the
  // page's stop button is pressed. Throws Error (an address that cannot be had).
  RenderView(const ViewOptions& options, const std::string& scene, std::atomic<bool>& stop);
  // Adds to `callbacks`; the view has to outlive them. Without anybody to watch nothing is added.
  void attach(RenderCallbacks& callbacks);
  // The picture is final and files are being written.
  void show_result(const RenderResult& result);
  // The last word; waits shortly for pages and viewer to take it.
  void finish(int exit_code, const std::vector<std::string>& outputs);

 private:
  bool wants_preview() const;
  void show_progress(const Progress& progress);
  void show_image(std::shared_ptr<const Image> image);
  void publish();

  std::unique_ptr<LiveServer> server_;
  std::unique_ptr<TevDisplay> display_;
  nlohmann::json status_;
  double next_status_ = 0.0;  // of Progress::elapsed [s]
};

}  // namespace pssmlt
