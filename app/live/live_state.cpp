#include "app/live/live_state.h"

#include <chrono>
#include <nlohmann/json.hpp>

namespace pssmlt {
namespace {

constexpr auto longest_wait = std::chrono::seconds(1);
// Without events: a browser that has gone without a word is noticed when it is written to.
constexpr auto heartbeat = std::chrono::seconds(5);

std::string event(const std::string& name, const std::string& data) {
  return "event: " + name + "\ndata: " + data + "\n\n";
}

}  // namespace

std::shared_ptr<const std::string> LiveImage::bytes() {
  std::call_once(once_, [this] {
    bytes_ = std::make_shared<const std::string>(encode_());
    encode_ = nullptr;
  });
  return bytes_;
}

void LiveState::set_file(const std::string& path, PublishedFile file) {
  const std::lock_guard lock(mutex_);
  std::swap(files_[path], file);
}

PublishedFile LiveState::file(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = files_.find(path);
  return found != files_.end() ? found->second : PublishedFile();
}

void LiveState::set_status(std::string text) {
  {
    const std::lock_guard lock(mutex_);
    status_.swap(text);
    status_version_ = ++version_;
  }
  changed_.notify_all();
}

void LiveState::set_image(const std::string& id, std::function<std::string()> encode) {
  std::shared_ptr<LiveImage> old;  // freed without the lock
  {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<LiveImage>& place = images_[id];
    old = std::move(place);
    place = std::make_shared<LiveImage>(++version_, std::move(encode));
  }
  changed_.notify_all();
}

std::shared_ptr<LiveImage> LiveState::image(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = images_.find(id);
  return found != images_.end() ? found->second : nullptr;
}

int LiveState::streams() const {
  const std::lock_guard lock(mutex_);
  return streams_;
}

void LiveState::wait_for_no_streams(double seconds) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return streams_ == 0; });
}

void LiveState::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

class LiveState::Stream {
 public:
  Stream(LiveState& state, std::string hello) : state_(state), hello_(std::move(hello)) {
    const std::lock_guard lock(state_.mutex_);
    ++state_.streams_;
  }
  ~Stream() {
    {
      const std::lock_guard lock(state_.mutex_);
      --state_.streams_;
    }
    state_.changed_.notify_all();
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  bool next(std::string& out) {
    if (!hello_.empty()) {
      out += event("hello", hello_);
      hello_.clear();
    }
    std::unique_lock lock(state_.mutex_);
    if (out.empty()) {
      state_.changed_.wait_for(lock, longest_wait,
                               [this] { return state_.closed_ || state_.version_ > seen_; });
    }
    if (state_.status_version_ > seen_) out += event("status", state_.status_);
    for (const auto& [id, image] : state_.images_) {
      if (image->version() <= seen_) continue;
      out += event("image", nlohmann::json{{"id", id}, {"version", image->version()}}.dump());
    }
    seen_ = state_.version_;
    beat(out);
    return !state_.closed_;
  }

 private:
  void beat(std::string& out) {
    const auto now = std::chrono::steady_clock::now();
    if (out.empty() && now - last_ > heartbeat) out += ":\n\n";
    if (!out.empty()) last_ = now;
  }
  LiveState& state_;
  std::string hello_;
  uint64_t seen_ = 0;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::function<bool(std::string&)> LiveState::make_stream(std::string hello) {
  const auto stream = std::make_shared<Stream>(*this, std::move(hello));
  return [stream](std::string& out) { return stream->next(out); };
}

}  // namespace pssmlt
