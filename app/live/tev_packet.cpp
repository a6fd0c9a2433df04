#include "app/live/tev_packet.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace pssmlt {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr int channels = 3;

class Packet {
 public:
  explicit Packet(TevType type) : bytes_(sizeof(uint32_t), '\0') {
    bytes_ += static_cast<char>(type);
    bytes_ += '\1';  // the viewer shall turn to the picture when it is made
  }
  void grab_focus(bool on) { bytes_[sizeof(uint32_t) + 1] = on ? '\1' : '\0'; }
  template <typename T>
  void add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add_text(const std::string& text) {
    bytes_ += text.substr(0, text.find('\0'));
    bytes_ += '\0';
  }
  void add_channel_names() {
    add(int32_t{channels});
    for (const char* name : {"R", "G", "B"}) add_text(name);
  }
  void add_floats(const float* from, size_t count) {
    bytes_.append(reinterpret_cast<const char*>(from), count * sizeof(float));
  }
  std::string finish() {
    const auto size = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string tev_create(const std::string& name, int width, int height) {
  Packet packet(TevType::create_image);
  packet.add_text(name);
  packet.add(int32_t{width});
  packet.add(int32_t{height});
  packet.add_channel_names();
  return packet.finish();
}

std::string tev_update(const std::string& name, const Image& image, const TevWindow& window) {
  Packet packet(TevType::update_image);
  packet.grab_focus(false);
  packet.add_text(name);
  packet.add_channel_names();
  for (const int v : {window.x, window.y, window.width, window.height}) packet.add(int32_t{v});
  for (int64_t c = 0; c < channels; ++c) packet.add(c);              // first value of each channel
  for (int c = 0; c < channels; ++c) packet.add(int64_t{channels});  // and the step from it
  for (int y = window.y; y < window.y + window.height; ++y) {
    packet.add_floats(image.pixel(window.x, y), static_cast<size_t>(window.width) * channels);
  }
  return packet.finish();
}

}  // namespace pssmlt
