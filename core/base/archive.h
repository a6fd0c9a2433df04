// Binary state for checkpoints: plain values, strings and arrays of plain values, in order.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/error.h"

namespace pssmlt {

// Writes by value(), reads by get(); a truncated archive throws Error instead of reading past the
// end. Byte order is the machine's own (the file's header names it).
class Archive {
 public:
  Archive() = default;
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)) {}
  const std::string& bytes() const { return bytes_; }

  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof(T));
  }
  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T v;
    take(&v, sizeof(T));
    return v;
  }
  template <typename T>
  void array(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value<uint64_t>(v.size());
    bytes_.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
  }
  template <typename T>
  std::vector<T> get_array() {
    const auto count = get<uint64_t>();
    if (count > (bytes_.size() - at_) / sizeof(T)) throw Error("checkpoint is truncated");
    std::vector<T> v(count);
    take(v.data(), count * sizeof(T));
    return v;
  }
  void text(const std::string& s) { array(std::vector<char>(s.begin(), s.end())); }
  std::string get_text() {
    const auto v = get_array<char>();
    return {v.begin(), v.end()};
  }

 private:
  void take(void* to, size_t size) {
    if (size > bytes_.size() - at_) throw Error("checkpoint is truncated");
    if (size != 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::string bytes_;
  size_t at_ = 0;
};

}  // namespace pssmlt
