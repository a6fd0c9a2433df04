#include "core/render/output.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/log.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> names_of(const Image& image) {
  if (!image.channel_names.empty()) return image.channel_names;
  if (image.channels == 1) return {"Y"};
  return {"R", "G", "B"};
}

// Folders that may take what the right one did not.
std::vector<fs::path> rescue_folders() {
  std::vector<fs::path> folders;
  std::error_code failed;
  const fs::path temporary = fs::temp_directory_path(failed);
  if (!failed) folders.push_back(temporary);
  if (const char* home = std::getenv("HOME")) folders.emplace_back(home);
  folders.emplace_back("/dev/shm");
  return folders;
}

}  // namespace

Image join_layers(const std::vector<std::pair<std::string, const Image*>>& layers) {
  const Image& first = *layers.front().second;
  Image joined;
  joined.width = first.width;
  joined.height = first.height;
  joined.channels = 0;
  for (const auto& [name, image] : layers) {
    if (image->data.empty()) continue;
    joined.channels += image->channels;
    for (const std::string& channel : names_of(*image)) {
      joined.channel_names.push_back(image == &first ? channel : name + "." + channel);
    }
  }
  const size_t pixels = static_cast<size_t>(first.width) * static_cast<size_t>(first.height);
  joined.data.reserve(pixels * static_cast<size_t>(joined.channels));
  for (size_t p = 0; p < pixels; ++p) {
    for (const auto& [name, image] : layers) {
      if (image->data.empty()) continue;
      const auto count = static_cast<ptrdiff_t>(image->channels);
      const auto begin = image->data.begin() + static_cast<ptrdiff_t>(p) * count;
      joined.data.insert(joined.data.end(), begin, begin + count);
    }
  }
  return joined;
}

bool write_or_rescue(const std::string& path, const Image& image, const ImageMetadata& metadata,
                     const DisplaySettings& display) {
  std::string reason;
  try {
    write_image(path, image, metadata, display);
    return true;
  } catch (const std::exception& failure) {
    reason = failure.what();
  }
  log_warning(reason);
  const fs::path asked(path);
  const std::string name =
      asked.stem().string() + "-" + std::to_string(getpid()) + asked.extension().string();
  for (const fs::path& folder : rescue_folders()) {
    const std::string other = (folder / ("pssmlt-" + name)).string();
    try {
      write_image(other, image, metadata, display);
      log_warning("the picture is in " + other + " instead of " + path);
      return false;
    } catch (const std::exception&) {
      continue;  // the next folder may have room
    }
  }
  throw Failure(reason + "; no other folder takes the picture either");
}

std::string with_suffix(const std::string& path, const std::string& suffix) {
  const fs::path p(path);
  return (p.parent_path() / (p.stem().string() + "." + suffix + p.extension().string())).string();
}

bool holds_layers(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".exr";
}

}  // namespace pssmlt
