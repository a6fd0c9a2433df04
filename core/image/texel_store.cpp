#include "core/image/texel_store.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "core/base/error.h"

namespace pssmlt {
namespace {

// Smaller pieces stay in the program's memory and count against the limit.
constexpr size_t smallest_mapped = size_t{64} << 10;
constexpr size_t chunk = size_t{256} << 10;  // what is given back at once
constexpr auto period = std::chrono::milliseconds(5);

const size_t page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
size_t whole_pages(size_t bytes) { return (bytes + page - 1) / page * page; }

struct Region {
  size_t bytes = 0;  // whole pages
  off_t offset = 0;  // in the file
};

// An unlinked file, which is gone with the program however that ends.
int temporary_file() {
  std::string name = (std::filesystem::temp_directory_path() / "pssmlt-texels-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) throw Failure("texture cache: cannot make " + name + ": " + std::strerror(errno));
  unlink(name.c_str());
  return file;
}

size_t resident_bytes(char* from, size_t bytes) {
  std::vector<unsigned char> pages(bytes / page);
  if (mincore(from, bytes, pages.data()) != 0) return bytes;
  return page * static_cast<size_t>(
                    std::ranges::count_if(pages, [](unsigned char p) { return (p & 1u) != 0; }));
}

// Never destroyed, since textures and the thread may outlive static objects.
class Store {
 public:
  static Store& instance() {
    static Store* const store = new Store;
    return *store;
  }

  void set_limit(uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    limit_ = bytes;
    if (bytes == 0 || watched_) return;
    watched_ = true;
    std::thread([this] { watch(); }).detach();
  }

  void* allocate(size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (limit_ == 0 || bytes < smallest_mapped) {
      void* const at = ::operator new(bytes);
      total_ += bytes;
      small_ += bytes;
      return at;
    }
    if (file_ < 0) file_ = temporary_file();
    const Region region{whole_pages(bytes), end_};
    const int error = posix_fallocate(file_, end_, static_cast<off_t>(region.bytes));
    if (error != 0)
      throw Failure("texture cache: no room for a temporary file: " +
                    std::string(std::strerror(error)));
    void* const at =
        mmap(nullptr, region.bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, region.offset);
    if (at == MAP_FAILED)
      throw Failure("texture cache: cannot map a file: " + std::string(std::strerror(errno)));
    end_ += static_cast<off_t>(region.bytes);
    total_ += bytes;
    // Neighbours in the file are no neighbours in the image: nothing is read ahead.
    madvise(at, region.bytes, MADV_RANDOM);
    regions_[static_cast<char*>(at)] = region;
    return at;
  }

  void free(void* texels, size_t bytes) {
    const std::lock_guard lock(mutex_);
    total_ -= bytes;
    const auto found = regions_.find(static_cast<char*>(texels));
    if (found == regions_.end()) {
      small_ -= bytes;
      ::operator delete(texels);
      return;
    }
    munmap(texels, found->second.bytes);
    fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, found->second.offset,
              static_cast<off_t>(found->second.bytes));
    regions_.erase(found);
  }

  TexelMemory memory() {
    const std::lock_guard lock(mutex_);
    trim();
    return {total_, small_ + mapped_resident(), limit_};
  }

 private:
  uint64_t mapped_resident() const {
    uint64_t sum = 0;
    for (const auto& [from, region] : regions_) sum += resident_bytes(from, region.bytes);
    return sum;
  }

  void watch() {
    for (;;) {
      const auto start = std::chrono::steady_clock::now();
      {
        const std::lock_guard lock(mutex_);
        trim();
      }
      // Looking takes at most a tenth of one thread's time.
      const auto spent = std::chrono::steady_clock::now() - start;
      std::this_thread::sleep_for(std::max<std::chrono::nanoseconds>(period, 9 * spent));
    }
  }

  // Gives chunks back, in turn, until an eighth of the limit is free.
  void trim() {
    if (limit_ == 0 || regions_.empty()) return;
    uint64_t resident = small_ + mapped_resident();
    if (resident <= limit_) return;
    const uint64_t goal = limit_ - limit_ / 8;
    uint64_t seen = 0, all = 0;
    for (const auto& [from, region] : regions_) all += region.bytes;
    while (resident > goal && seen < all) {
      auto at = regions_.upper_bound(hand_);
      if (at != regions_.begin() && hand_ < std::prev(at)->first + std::prev(at)->second.bytes) {
        --at;
      } else {
        if (at == regions_.end()) at = regions_.begin();
        hand_ = at->first;
      }
      const auto offset = static_cast<size_t>(hand_ - at->first);
      const size_t bytes = std::min(chunk, at->second.bytes - offset);
      resident -= std::min<uint64_t>(resident, give_back(at->second, hand_, offset, bytes));
      hand_ += bytes;
      seen += bytes;
    }
  }

  // What was written while an image was loaded goes to the file first; then neither the program nor
  // the system's file cache keeps the pages. Returns the bytes that were in memory.
  size_t give_back(const Region& region, char* from, size_t offset, size_t bytes) const {
    const size_t before = resident_bytes(from, bytes);
    if (before == 0) return 0;
    msync(from, bytes, MS_SYNC);
    madvise(from, bytes, MADV_DONTNEED);
    posix_fadvise(file_, region.offset + static_cast<off_t>(offset), static_cast<off_t>(bytes),
                  POSIX_FADV_DONTNEED);
    return before - std::min(before, resident_bytes(from, bytes));
  }

  std::mutex mutex_;
  std::map<char*, Region> regions_;
  char* hand_ = nullptr;  // where trim() goes on
  int file_ = -1;
  off_t end_ = 0;  // of what the file is used for
  uint64_t limit_ = 0, total_ = 0, small_ = 0;
  bool watched_ = false;
};

}  // namespace

void set_texture_cache(uint64_t bytes) {
  if (bytes != 0) {
    const std::string folder = std::filesystem::temp_directory_path().string();
    struct statfs where {};
    if (statfs(folder.c_str(), &where) == 0 &&
        (where.f_type == TMPFS_MAGIC || where.f_type == RAMFS_MAGIC)) {
      throw Error("texture cache: the folder " + folder +
                  " lies in memory; TMPDIR must name one on a disk");
    }
  }
  Store::instance().set_limit(bytes);
}

TexelMemory texel_memory() { return Store::instance().memory(); }
void* allocate_texels(size_t bytes) { return Store::instance().allocate(bytes); }
void free_texels(void* texels, size_t bytes) { Store::instance().free(texels, bytes); }

uint64_t parse_bytes(const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, value);
  while (at != end && *at == ' ') ++at;
  std::string unit(at, end);
  if (unit.ends_with('B')) unit.pop_back();
  const bool binary = unit.ends_with('i');
  if (binary) unit.pop_back();
  constexpr std::string_view units = "kMGT";
  const size_t power = unit.empty() ? 0 : units.find(unit == "K" ? "k" : unit) + 1;
  const double bytes = value * std::pow(binary ? 1024.0 : 1000.0, static_cast<double>(power));
  if (error != std::errc() || unit.size() > 1 || (power == 0 && !unit.empty()) ||
      (power == 0 && binary) || !(bytes >= 0.0 && bytes < 1e18))
    throw Error("\"" + text + "\" is no amount of memory, such as 1GB or 512MiB");
  return static_cast<uint64_t>(bytes);
}

}  // namespace pssmlt
