#include "app/live/render_view.h"

#include "app/live/half_image.h"

namespace pssmlt {
namespace {

constexpr double status_interval = 0.25;    // [s]
constexpr double last_word_seconds = 1.0;   // for pages to take the end [s]
constexpr double last_image_seconds = 2.0;  // for the viewer to take the last picture [s]

nlohmann::json error_json(const ErrorEstimate& e) {
  if (!e.known) return {{"known", false}, {"why", e.why}};
  return {{"known", true}, {"relmse", e.relative_mse}, {"low", e.low}, {"high", e.high}};
}

std::string state_of(RenderPhase phase) {
  switch (phase) {
    case RenderPhase::prepare:
      return "preparing";
    case RenderPhase::bootstrap:
      return "bootstrap";
    case RenderPhase::render:
      break;
  }
  return "rendering";
}

}  // namespace

RenderView::RenderView(const ViewOptions& options, const std::string& scene,
                       std::atomic<bool>& stop)
    : status_({{"state", "loading"}, {"scene", scene}, {"final", false}}) {
  if (!options.display.empty()) {
    display_ = std::make_unique<TevDisplay>(options.display, scene + " (pssmlt)");
  }
  server_ = serve(options.page, live_page_files(), status_, stop);
}

void RenderView::publish() {
  if (server_) server_->publish(status_);
}

bool RenderView::wants_preview() const {
  return (server_ && server_->watched()) || (display_ && display_->ready());
}

void RenderView::attach(RenderCallbacks& callbacks) {
  if (!server_ && !display_) return;
  callbacks.progress = [this, other = callbacks.progress](const Progress& p) {
    if (other) other(p);
    show_progress(p);
  };
  callbacks.wants_preview = [this] { return wants_preview(); };
  callbacks.preview = [this](Preview preview) {
    status_["layers"] = std::move(preview.layers);
    status_["image"] = {{"seconds", preview.seconds}, {"samples", preview.samples}};
    publish();
    show_image(std::make_shared<const Image>(std::move(preview.image)));
  };
}

void RenderView::show_image(std::shared_ptr<const Image> image) {
  if (server_) server_->publish_image("picture", [image] { return half_image(*image); });
  if (display_) display_->show(std::move(image));
}

void RenderView::show_progress(const Progress& p) {
  if (!server_ || p.elapsed < next_status_) return;
  next_status_ = p.elapsed + status_interval;
  status_["state"] = state_of(p.phase);
  status_["elapsed"] = p.elapsed;
  status_["fraction"] = p.fraction;
  status_["remaining"] = p.remaining >= 0.0 ? nlohmann::json(p.remaining) : nlohmann::json();
  status_["samples"] = p.samples;
  status_["samples_per_second"] = p.samples_per_second;
  status_["chains"] = p.chains;
  if (p.error != nullptr) status_["error"] = error_json(*p.error);
  publish();
}

void RenderView::show_result(const RenderResult& result) {
  if (!server_ && !display_) return;
  status_["state"] = "writing";
  status_["stopped_by"] = to_string(result.stop);
  status_["elapsed"] = result.seconds;
  status_["samples"] = result.samples;
  status_["samples_per_second"] = result.seconds > 0.0 ? result.samples / result.seconds : 0.0;
  status_["remaining"] = 0.0;
  status_["error"] = error_json(result.error);
  status_["layers"] = result.statistics.value("layers", nlohmann::json::array());
  status_["image"] = {{"seconds", result.seconds}, {"samples", result.samples}};
  publish();
  if (result.complete) show_image(std::make_shared<const Image>(result.image));
}

void RenderView::finish(int exit_code, const std::vector<std::string>& outputs) {
  status_["state"] = "finished";
  status_["final"] = true;
  status_["exit_code"] = exit_code;
  status_["outputs"] = outputs;
  publish();
  if (display_) display_->drain(last_image_seconds);
  if (server_) server_->drain(last_word_seconds);
}

}  // namespace pssmlt
