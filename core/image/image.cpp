#include "core/image/image.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>

#include "core/base/error.h"
#include "core/base/float_traps.h"
#include "core/image/embedded_file.h"
#include "core/image/encoding.h"
#include "core/image/image_file.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> float_formats = {"exr", "pfm", "hdr"};
constexpr std::array<std::string_view, 3> display_formats = {"png", "jpg", "jpeg"};

template <typename Function>
Function* module_function(const char* module, const char* symbol) {
  return reinterpret_cast<Function*>(Registry::instance().module(module, symbol));
}

bool contains(std::span<const std::string_view> formats, const std::string& format) {
  return std::ranges::find(formats, format) != formats.end();
}

// The ending in lower case, without its dot.
std::string format_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

// Beside the file, so that renaming is atomic; with its ending, which some writers look at.
std::string temporary_for(const std::string& path) {
  const fs::path p(path);
  const std::string name = "." + p.stem().string() + ".tmp" + std::to_string(getpid());
  return (p.parent_path() / (name + p.extension().string())).string();
}

// Removes the temporary file unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target)
      : target_(target), path_(temporary_for(target)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    if (!done_) fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }
  void commit() {
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) throw Failure("cannot write " + target_ + ": " + error.message());
    done_ = true;
  }

 private:
  std::string target_, path_;
  bool done_ = false;
};

std::array<int, 3> rgb_channels(const Image& image) {
  std::array<int, 3> result = {0, 1, 2};
  const auto& names = image.channel_names;
  for (size_t i = 0; i < 3; ++i) {
    const auto at = std::ranges::find(names, std::string(1, "RGB"[i]));
    if (at == names.end()) return image.channels < 3 ? std::array{0, 0, 0} : std::array{0, 1, 2};
    result[i] = static_cast<int>(at - names.begin());
  }
  return result;
}

ByteImage to_display(const Image& image, const DisplaySettings& display) {
  const std::array<int, 3> from = rgb_channels(image);
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  std::vector<float> rgb(3 * count);
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const float v =
          image.data[i * static_cast<size_t>(image.channels) + static_cast<size_t>(from[c])];
      // Above what a half float holds, transforms of displays are not defined.
      rgb[3 * i + c] = std::isnan(v) ? 0.f : std::clamp(v, -65504.f, 65504.f);
    }
  }
  const NoFloatTraps library;
  const auto show = module_function<DisplayFunction>("display", display_symbol);
  show(rgb, image.width, image.height, display.view);
  ByteImage result{image.width, image.height, 3, std::vector<uint8_t>(rgb.size())};
  std::ranges::transform(rgb, result.data.begin(), [](float v) {
    return static_cast<uint8_t>(std::isnan(v) ? 0.f : std::clamp(v, 0.f, 1.f) * 255.f + 0.5f);
  });
  return result;
}

}  // namespace

int ImageFile::find(const std::string& name) const {
  const auto at = std::ranges::find(channel_names, name);
  return at == channel_names.end() ? -1 : static_cast<int>(at - channel_names.begin());
}

ImageFile read_image_file(const std::string& path) {
  const NoFloatTraps library;
  ImageFile file;
  if (const auto embedded = find_embedded_file(path)) {
    module_function<ReadBytesFunction>("image_io", read_bytes_symbol)(*embedded, file);
  } else {
    module_function<ReadFunction>("image_io", read_symbol)(path, file);
  }
  return file;
}

Image read_image(const std::string& path, const std::string& encoding) {
  return decode_image(read_image_file(path), encoding);
}

Image decode_image(const ImageFile& file, const std::string& encoding) {
  Encoding from = file.integer ? Encoding::srgb() : Encoding::linear();
  if (!encoding.empty()) from = Encoding::parse(encoding);
  Image image(file.width, file.height, file.channels);
  image.channel_names = file.channel_names;
  const int alpha = file.find("A");
  const auto channels = static_cast<size_t>(file.channels);
  for (size_t i = 0; i < image.data.size(); ++i) {
    const float stored =
        file.bytes.empty() ? file.floats[i] : static_cast<float>(file.bytes[i]) / 255.f;
    const bool is_alpha = static_cast<int>(i % channels) == alpha;
    image.data[i] = is_alpha || from.is_linear() ? stored : from.to_linear(stored);
  }
  return image;
}

void write_image(const std::string& path, const Image& image, const ImageMetadata& metadata,
                 const DisplaySettings& display) {
  const NoFloatTraps library;
  const std::string format = format_of(path);
  TemporaryFile temporary(path);
  try {
    if (contains(display_formats, format)) {
      const ByteImage bytes = to_display(image, display);
      module_function<WriteBytesFunction>("image_io", write_bytes_symbol)(temporary.path(), format,
                                                                          bytes);
    } else if (contains(float_formats, format)) {
      module_function<WriteFunction>("image_io", write_symbol)(temporary.path(), format, image,
                                                               metadata);
    } else {
      throw Failure("cannot write " + path + ": unknown image format '" + format + "'");
    }
  } catch (const Failure& failure) {
    // The file that was asked for, not the one beside it that only the writer knows.
    std::string message = failure.what();
    const size_t at = message.find(temporary.path());
    if (at != std::string::npos) message.replace(at, temporary.path().size(), path);
    throw Failure(message);
  }
  temporary.commit();
}

void check_writable(const std::string& path) {
  const std::string format = format_of(path);
  if (!contains(float_formats, format) && !contains(display_formats, format))
    throw Error("cannot write " + path + ": unknown image format '" + format +
                "' (exr, pfm, hdr, png or jpg expected)");
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error("cannot write " + path + ": is a directory");
  const TemporaryFile temporary(path);
  const int file = open(temporary.path().c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) throw Error("cannot write " + path + ": " + std::strerror(errno));
  close(file);
}

void check_view(const DisplaySettings& display) {
  const NoFloatTraps library;
  std::vector<float> pixel(3);
  module_function<DisplayFunction>("display", display_symbol)(pixel, 1, 1, display.view);
}

}  // namespace pssmlt
