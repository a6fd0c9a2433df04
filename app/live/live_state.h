// What a live server's threads share: the newest status and images, and the streams that tell of
// them.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace pssmlt {

// A published image, encoded when it is first asked for.
class LiveImage {
 public:
  LiveImage(uint64_t version, std::function<std::string()> encode)
      : version_(version), encode_(std::move(encode)) {}
  uint64_t version() const { return version_; }
  // What encode() throws gets out; the next call tries again.
  std::shared_ptr<const std::string> bytes();

 private:
  uint64_t version_;
  std::once_flag once_;
  std::function<std::string()> encode_;
  std::shared_ptr<const std::string> bytes_;
};

// A file that is served as it is.
struct PublishedFile {
  std::string type;
  std::function<std::shared_ptr<const std::string>()> read;  // empty: there is no such file
};

class LiveState {
 public:
  void set_file(const std::string& path, PublishedFile file);
  PublishedFile file(const std::string& path) const;
  void set_status(std::string text);
  void set_image(const std::string& id, std::function<std::string()> encode);
  std::shared_ptr<LiveImage> image(const std::string& id) const;  // null: there is none

  // A stream's part of a server-sent event source: appends what is new since the last call, waiting
  // for it for a second at most. It begins with the event "hello" with these data. False: the end.
  std::function<bool(std::string&)> make_stream(std::string hello);
  int streams() const;
  // Waits until there are no streams, `seconds` at most.
  void wait_for_no_streams(double seconds) const;
  // All streams end.
  void close();

 private:
  class Stream;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  uint64_t version_ = 0;  // of what was published last
  uint64_t status_version_ = 0;
  std::string status_;
  std::map<std::string, std::shared_ptr<LiveImage>> images_;
  std::map<std::string, PublishedFile> files_;
  int streams_ = 0;
  bool closed_ = false;
};

}  // namespace pssmlt
