#include "core/shapes/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/scene/tokenizer.h"

namespace pssmlt {
namespace {

enum class Type : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
enum class Format : uint8_t { Ascii, LittleEndian, BigEndian };

struct Property {
  std::string name;
  Type type = Type::Float32;
  std::optional<Type> count;  // of the list's length; none: a scalar
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
  bool has_lists() const {
    return std::ranges::any_of(properties, [](const Property& p) { return p.count.has_value(); });
  }
};

size_t size_of(Type type) {
  constexpr std::array<size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

std::optional<Type> type_named(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (size_t i = 0; i < names.size(); ++i)
    if (name == names[i][0] || name == names[i][1]) return static_cast<Type>(i);
  return std::nullopt;
}

// A value of type T at p, in the machine's byte order after an optional swap.
template <typename T>
T load(const char* p, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), p, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

template <typename R>
R load_as(const char* p, Type type, bool swap) {
  switch (type) {
    case Type::Int8:
      return static_cast<R>(load<int8_t>(p, swap));
    case Type::Uint8:
      return static_cast<R>(load<uint8_t>(p, swap));
    case Type::Int16:
      return static_cast<R>(load<int16_t>(p, swap));
    case Type::Uint16:
      return static_cast<R>(load<uint16_t>(p, swap));
    case Type::Int32:
      return static_cast<R>(load<int32_t>(p, swap));
    case Type::Uint32:
      return static_cast<R>(load<uint32_t>(p, swap));
    case Type::Float32:
      return static_cast<R>(load<float>(p, swap));
    case Type::Float64:
      return static_cast<R>(load<double>(p, swap));
  }
  return R(0);
}

// Where the numbers of a vertex property go: 0-2 position, 3-5 normal, 6-7 texture coordinates; -1:
// nowhere.
int vertex_slot(std::string_view name) {
  constexpr std::array<std::string_view, 6> vector{"x", "y", "z", "nx", "ny", "nz"};
  for (size_t i = 0; i < vector.size(); ++i)
    if (name == vector[i]) return static_cast<int>(i);
  for (const std::string_view u : {"u", "s", "texture_u", "texture_s"})
    if (name == u) return 6;
  for (const std::string_view v : {"v", "t", "texture_v", "texture_t"})
    if (name == v) return 7;
  return -1;
}

class PlyReader {
 public:
  PlyReader(const std::string& text, const std::string& path, const Location& where)
      : at_(text.data()), end_(text.data() + text.size()), path_(path), where_(where) {}

  MeshData read() {
    header();
    bool has_vertices = false, has_faces = false;
    for (const Element& e : elements_) {
      if (e.name == "vertex") {
        vertices(e);
        has_vertices = true;
      } else if (e.name == "face") {
        faces(e);
        has_faces = true;
      } else {
        skip(e);
      }
    }
    if (!has_vertices) fail("there are no vertices");
    if (!has_faces) fail("there are no faces");
    check_indices();
    return std::move(data_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(where_, "PLY file '" + path_ + "': " + message);
  }
  [[noreturn]] void truncated(const Element& e) const {
    fail("the file ends within its " + std::to_string(e.count) + " elements \"" + e.name + "\"");
  }
  uint64_t left() const { return static_cast<uint64_t>(end_ - at_); }

  std::string_view line() {
    const char* const newline = std::find(at_, end_, '\n');
    if (newline == end_) fail("the header does not end");
    std::string_view text(at_, static_cast<size_t>(newline - at_));
    at_ = newline + 1;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  void header() {
    if (left() < 4 || std::string_view(at_, 3) != "ply") fail("this is not a PLY file");
    line();
    bool has_format = false;
    for (;;) {
      const std::string text(line());
      std::istringstream words(text);
      std::string keyword;
      words >> keyword;
      if (keyword == "end_header") break;
      if (keyword == "format") {
        std::string name;
        words >> name;
        format(name);
        has_format = true;
      } else if (keyword == "element") {
        Element e;
        if (!(words >> e.name >> e.count)) fail("bad header line '" + text + "'");
        elements_.push_back(e);
      } else if (keyword == "property") {
        property(words, text);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail("bad header line '" + text + "'");
      }
    }
    if (!has_format) fail("the header names no format");
  }

  void format(const std::string& name) {
    if (name == "ascii")
      format_ = Format::Ascii;
    else if (name == "binary_little_endian")
      format_ = Format::LittleEndian;
    else if (name == "binary_big_endian")
      format_ = Format::BigEndian;
    else
      fail("unknown format '" + name + "'");
    swap_ = format_ ==
            (std::endian::native == std::endian::little ? Format::BigEndian : Format::LittleEndian);
  }

  void property(std::istringstream& words, const std::string& text) {
    if (elements_.empty()) fail("a property before the first element: '" + text + "'");
    Property p;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count;
      words >> count >> type;
      p.count = type_named(count);
      if (!p.count || *p.count >= Type::Float32) fail("bad header line '" + text + "'");
    }
    const auto known = type_named(type);
    if (!known || !(words >> p.name)) fail("bad header line '" + text + "'");
    p.type = *known;
    elements_.back().properties.push_back(p);
  }

  // One number of an ASCII file.
  double number(const Element& e) {
    while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
    if (at_ == end_) truncated(e);
    double value = 0.0;
    const auto [after, error] = std::from_chars(*at_ == '+' ? at_ + 1 : at_, end_, value);
    if (error != std::errc() || (after != end_ && static_cast<unsigned char>(*after) > ' ')) {
      const char* const stop = std::find_if(at_, std::min(end_, at_ + 20), [](char c) {
        return static_cast<unsigned char>(c) <= ' ';
      });
      fail("'" + std::string(at_, stop) + "' is not a number");
    }
    at_ = after;
    return value;
  }

  // One value of any format.
  template <typename R>
  R value(Type type, const Element& e) {
    if (format_ == Format::Ascii) return static_cast<R>(number(e));
    const size_t size = size_of(type);
    if (left() < size) truncated(e);
    const R v = load_as<R>(at_, type, swap_);
    at_ += size;
    return v;
  }

  // Number of items of a list that follows.
  uint64_t list_length(const Property& p, const Element& e) {
    const double count = value<double>(*p.count, e);
    // An item takes a byte at least, so that a longer list cannot be there.
    if (!(count >= 0.0 && count <= static_cast<double>(left())))
      fail("a list \"" + p.name + "\" has the impossible length " + std::to_string(count));
    return static_cast<uint64_t>(count);
  }

  void skip(const Property& p, const Element& e) {
    const uint64_t count = p.count ? list_length(p, e) : 1;
    if (format_ == Format::Ascii) {
      for (uint64_t i = 0; i < count; ++i) number(e);
      return;
    }
    if (left() / size_of(p.type) < count) truncated(e);
    at_ += count * size_of(p.type);
  }
  void skip(const Element& e) {
    if (e.properties.empty()) return;
    for (uint64_t i = 0; i < e.count; ++i)
      for (const Property& p : e.properties) skip(p, e);
  }

  // Bytes of a fixed-size row; checks that all rows are there before anything is allocated.
  size_t stride(const Element& e) const {
    size_t bytes = 0;
    for (const Property& p : e.properties) bytes += size_of(p.type);
    if (bytes == 0 || left() / bytes < e.count) truncated(e);
    return bytes;
  }

  void vertices(const Element& e) {
    std::vector<int> slots;
    unsigned found = 0;
    for (const Property& p : e.properties) {
      slots.push_back(p.count ? -1 : vertex_slot(p.name));
      if (slots.back() >= 0) found |= 1u << slots.back();
    }
    if ((found & 7u) != 7u) fail("vertices lack x, y or z");
    const bool has_normals = (found & 0x38u) == 0x38u, has_uvs = (found & 0xC0u) == 0xC0u;
    // A number of an ASCII file takes two characters at least (the last one may take one).
    if (format_ == Format::Ascii && (left() + 1) / 2 / e.properties.size() < e.count) truncated(e);
    if (format_ != Format::Ascii && !e.has_lists()) stride(e);
    if (e.count > std::min<uint64_t>(left() + 1, 0xFFFFFFFFu)) truncated(e);
    TriangleMesh& m = data_.mesh;
    m.positions.reserve(e.count);
    if (has_normals) m.normals.reserve(e.count);
    if (has_uvs) m.uvs.reserve(e.count);
    std::array<float, 8> v{};
    for (uint64_t i = 0; i < e.count; ++i) {
      vertex(e, slots, v);
      m.positions.emplace_back(v[0], v[1], v[2]);
      if (has_normals) m.normals.emplace_back(v[3], v[4], v[5]);
      if (has_uvs) m.uvs.emplace_back(v[6], v[7]);
    }
  }

  void vertex(const Element& e, const std::vector<int>& slots, std::array<float, 8>& v) {
    for (size_t k = 0; k < slots.size(); ++k) {
      const Property& p = e.properties[k];
      if (slots[k] < 0)
        skip(p, e);
      else
        v[static_cast<size_t>(slots[k])] = value<float>(p.type, e);
    }
  }

  void faces(const Element& e) {
    const auto is_indices = [](const Property& p) {
      return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    const auto list = std::ranges::find_if(e.properties, is_indices);
    if (list == e.properties.end()) fail("faces lack the list \"vertex_indices\"");
    if (e.count > left()) truncated(e);
    data_.mesh.triangles.reserve(e.count);
    for (uint64_t i = 0; i < e.count; ++i)
      for (const Property& p : e.properties) {
        if (&p == &*list)
          polygon(p, e);
        else
          skip(p, e);
      }
  }

  void polygon(const Property& p, const Element& e) {
    if (fast_triangle(p)) return;
    const uint64_t count = list_length(p, e);
    if (count < 3) fail("a face has " + std::to_string(count) + " vertices");
    const uint32_t first = index(p, e);
    uint32_t before = index(p, e);
    for (uint64_t k = 2; k < count; ++k) {
      const uint32_t next = index(p, e);
      data_.mesh.triangles.emplace_back(first, before, next);
      before = next;
    }
  }

  // The usual binary case: one byte 3, then three 32-bit numbers. Signed ones need no extra care: a
  // negative index is out of range as an unsigned one.
  bool fast_triangle(const Property& p) {
    if (format_ == Format::Ascii || size_of(*p.count) != 1 || left() < 13 || *at_ != 3 ||
        (p.type != Type::Int32 && p.type != Type::Uint32))
      return false;
    data_.mesh.triangles.emplace_back(load<uint32_t>(at_ + 1, swap_),
                                      load<uint32_t>(at_ + 5, swap_),
                                      load<uint32_t>(at_ + 9, swap_));
    at_ += 13;
    return true;
  }

  uint32_t index(const Property& p, const Element& e) {
    const double i = value<double>(p.type, e);
    if (!(i >= 0.0 && i < 4294967295.0) || i != std::floor(i))
      fail("a face has the index " + std::to_string(i));
    return static_cast<uint32_t>(i);
  }

  void check_indices() const {
    const size_t count = data_.mesh.positions.size();
    for (const glm::uvec3& t : data_.mesh.triangles)
      if (std::max({t.x, t.y, t.z}) >= count)
        fail("a face has the index " + std::to_string(std::max({t.x, t.y, t.z})) +
             ", but there are " + std::to_string(count) + " vertices");
  }

  const char* at_;
  const char* end_;
  const std::string& path_;
  const Location& where_;
  Format format_ = Format::Ascii;
  bool swap_ = false;
  std::vector<Element> elements_;
  MeshData data_;
};

}  // namespace

MeshData parse_ply(const std::string& text, const std::string& path, const Location& where) {
  return PlyReader(text, path, where).read();
}

MeshData read_ply(const std::string& path, const Location& where) {
  return parse_ply(read_text(path, where), path, where);
}

}  // namespace pssmlt
