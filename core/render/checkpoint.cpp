#include "core/render/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/plugin/registry.h"

namespace pssmlt {
namespace {

constexpr char magic_word[8] = {'P', 'S', 'S', 'M', 'L', 'T', 'C', 'P'};
constexpr uint32_t format_version = 3;
constexpr uint32_t order_mark = 0x01020304;  // reads differently on another byte order

struct Header {
  char magic[8];
  uint32_t version = format_version;
  uint32_t byte_order = order_mark;
  CheckpointIdentity identity;
  uint64_t size = 0;      // of the state [bytes]
  uint64_t checksum = 0;  // of identity, size and state
};

uint64_t checksum(const Header& header, const std::string& state) {
  const uint64_t start = hash_bytes(&header.identity, sizeof header.identity, header.size);
  return hash_bytes(state.data(), state.size(), start);
}

std::string reason() { return std::strerror(errno); }

// Writes everything and flushes it to the disk; false with errno set.
bool write_all(int file, const void* data, size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size != 0) {
    const ssize_t written = ::write(file, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    at += written;
    size -= static_cast<size_t>(written);
  }
  return true;
}

void check_identity(const std::string& path, const CheckpointIdentity& found,
                    const CheckpointIdentity& wanted) {
  const auto refuse = [&](const std::string& what) {
    throw Error("cannot resume from \"" + path + "\": it belongs to " + what);
  };
  if (found.scene != wanted.scene) refuse("another scene (the scene's text differs)");
  if (found.settings != wanted.settings) {
    refuse("other settings (seed, size, integrator, sampler or their parameters differ)");
  }
  if (found.plugins != wanted.plugins) refuse("other plugins (their files or the version differ)");
}

}  // namespace

uint64_t hash_bytes(const void* data, size_t size, uint64_t start) {
  const char* at = static_cast<const char*>(data);
  uint64_t hash = mix_bits(start ^ size);
  for (; size >= 8; at += 8, size -= 8) {
    uint64_t word;
    std::memcpy(&word, at, 8);
    // One multiplication a word; the rotation carries high bits down.
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  }
  uint64_t rest = 0;
  if (size != 0) std::memcpy(&rest, at, size);
  return mix_bits(hash ^ rest);
}

void write_checkpoint(const std::string& path, const CheckpointIdentity& identity,
                      const std::string& state) {
  Header header{};
  std::memcpy(header.magic, magic_word, sizeof header.magic);
  header.identity = identity;
  header.size = state.size();
  header.checksum = checksum(header, state);
  const std::string temporary = path + ".part";
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw Failure("cannot write \"" + temporary + "\": " + reason());
  const bool written = write_all(file, &header, sizeof header) &&
                       write_all(file, state.data(), state.size()) && ::fsync(file) == 0;
  const std::string why = written ? "" : reason();
  ::close(file);
  if (!written || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string message = written ? reason() : why;
    std::remove(temporary.c_str());
    throw Failure("cannot write \"" + path + "\": " + message);
  }
}

std::string read_checkpoint(const std::string& path, const CheckpointIdentity& identity) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot read checkpoint \"" + path + "\": " + reason());
  const std::string damaged = "checkpoint \"" + path + "\" is damaged";
  Header header;
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header) ||
      std::memcmp(header.magic, magic_word, sizeof header.magic) != 0) {
    throw Error("\"" + path + "\" is not a checkpoint");
  }
  if (header.byte_order != order_mark) {
    throw Error("checkpoint \"" + path + "\" comes from a machine of another byte order");
  }
  if (header.version != format_version) {
    throw Error("checkpoint \"" + path + "\" has format version " + std::to_string(header.version) +
                ", this program reads version " + std::to_string(format_version));
  }
  std::error_code failed;
  const auto length = std::filesystem::file_size(path, failed);
  if (failed || length != sizeof header + header.size) throw Error(damaged + " (truncated)");
  std::string state(header.size, '\0');
  if (!file.read(state.data(), static_cast<std::streamsize>(state.size()))) {
    throw Error(damaged + " (truncated)");
  }
  if (checksum(header, state) != header.checksum) throw Error(damaged + " (wrong checksum)");
  check_identity(path, header.identity, identity);
  return state;
}

uint64_t plugins_hash() {
  std::vector<uint64_t> hashes;
  for (const std::string& file : Registry::instance().loaded()) {
    if (std::filesystem::path(file).parent_path().filename() == "module") continue;
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    hashes.push_back(hash_bytes(bytes.data(), bytes.size()));
  }
  std::sort(hashes.begin(), hashes.end());  // whatever the order of loading
  const std::string version = PSSMLT_VERSION;
  return hash_bytes(hashes.data(), hashes.size() * sizeof(uint64_t),
                    hash_bytes(version.data(), version.size()));
}

}  // namespace pssmlt
