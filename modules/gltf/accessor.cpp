#include "modules/gltf/accessor.h"

#include <cstring>
#include <limits>

namespace pssmlt::gltf {
namespace {

// Elements of an accessor without data, which are zero: the only ones that cost a file nothing.
constexpr size_t most_zeros = size_t{1} << 24;

// Numbers in a buffer, all of them there.
struct Stored {
  const unsigned char* data = nullptr;
  size_t count = 0, stride = 0, component_size = 0;
  int components = 0, type = 0;
  bool normalized = false;

  template <typename T>
  static T load(const unsigned char* p) {
    T v;
    std::memcpy(&v, p, sizeof(T));
    return v;
  }
  template <typename T>
  float fraction(const unsigned char* p) const {
    const T v = load<T>(p);
    if (!normalized) return static_cast<float>(v);
    return std::max(-1.f,
                    static_cast<float>(v) / static_cast<float>(std::numeric_limits<T>::max()));
  }
  const unsigned char* at(size_t i, int c) const {
    return data + i * stride + static_cast<size_t>(c) * component_size;
  }
  float number(size_t i, int c) const {
    const unsigned char* const p = at(i, c);
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return fraction<int8_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return fraction<uint8_t>(p);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return fraction<int16_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return fraction<uint16_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return fraction<uint32_t>(p);
      default:
        return load<float>(p);
    }
  }
  uint32_t integer(size_t i, int c) const {
    const unsigned char* const p = at(i, c);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *p;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<uint16_t>(p);
    return load<uint32_t>(p);
  }
};

size_t size_of(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// `stride`: 0 if elements follow each other. Fails at `pointer` unless all of it lies in the view.
Stored stored(const Document& d, int view, size_t offset, size_t stride, int type, int components,
              size_t count, const std::string& pointer) {
  const std::span<const unsigned char> bytes = d.view(view, pointer);
  Stored s{nullptr, count, stride, size_of(type), components, type, false};
  if (s.component_size == 0) d.fail(pointer, "has an unknown component type");
  const size_t element = s.component_size * static_cast<size_t>(components);
  if (s.stride == 0) s.stride = element;
  if (count > 0 && (offset > bytes.size() || element > bytes.size() - offset ||
                    count - 1 > (bytes.size() - offset - element) / s.stride))
    d.fail(pointer, "reaches beyond its buffer view");
  s.data = bytes.data() + std::min(offset, bytes.size());
  return s;
}

const tinygltf::Accessor& find(const Document& d, int index, const std::string& pointer) {
  return d.get(d.model().accessors, index, "accessors", pointer);
}

void check_offset(const Document& d, int offset, const std::string& pointer) {
  if (offset < 0) d.fail(pointer, "has a negative byteOffset");
}

// Calls set(element, component, source, its element) for all elements stored, then the sparse ones.
template <typename Set>
void read(const Document& d, int index, int components, const std::string& pointer,
          const Set& set) {
  const tinygltf::Accessor& a = find(d, index, pointer);
  const std::string here = element("accessors", index);
  if (a.bufferView >= 0) {
    const tinygltf::BufferView& view =
        d.get(d.model().bufferViews, a.bufferView, "bufferViews", here);
    Stored s = stored(d, a.bufferView, a.byteOffset, view.byteStride, a.componentType, components,
                      a.count, here);
    s.normalized = a.normalized;
    for (size_t i = 0; i < a.count; ++i)
      for (int c = 0; c < components; ++c) set(i, c, s, i);
  }
  if (!a.sparse.isSparse) return;
  const auto& sparse = a.sparse;
  if (sparse.count < 0 || static_cast<size_t>(sparse.count) > a.count)
    d.fail(here + ".sparse", "has more elements than the accessor");
  check_offset(d, sparse.indices.byteOffset, here + ".sparse.indices");
  check_offset(d, sparse.values.byteOffset, here + ".sparse.values");
  if (!is_unsigned(sparse.indices.componentType))
    d.fail(here + ".sparse.indices", "must be unsigned integers");
  const auto count = static_cast<size_t>(sparse.count);
  const Stored where =
      stored(d, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset), 0,
             sparse.indices.componentType, 1, count, here + ".sparse.indices");
  Stored values = stored(d, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                         0, a.componentType, components, count, here + ".sparse.values");
  values.normalized = a.normalized;
  for (size_t i = 0; i < count; ++i) {
    const size_t target = where.integer(i, 0);
    if (target >= a.count) d.fail(here + ".sparse.indices", "an index is out of range");
    for (int c = 0; c < components; ++c) set(target, c, values, i);
  }
}

// The size of the result, once it is known to be backed by data. Room for it is made by the caller.
size_t check(const Document& d, int index, int components, const std::string& pointer) {
  const tinygltf::Accessor& a = find(d, index, pointer);
  const std::string here = element("accessors", index);
  const int found = component_count(d, index, pointer);
  if (found != components)
    d.fail(here, "has " + std::to_string(found) + " components, " + std::to_string(components) +
                     " are needed for " + pointer);
  check_backed(d, index, pointer);
  return a.count * static_cast<size_t>(components);
}

}  // namespace

int component_count(const Document& d, int index, const std::string& pointer) {
  const int n =
      tinygltf::GetNumComponentsInType(static_cast<uint32_t>(find(d, index, pointer).type));
  if (n <= 0) d.fail(element("accessors", index), "has an unknown type");
  return n;
}

void check_backed(const Document& d, int index, const std::string& pointer) {
  const tinygltf::Accessor& a = find(d, index, pointer);
  const std::string here = element("accessors", index);
  if (a.bufferView < 0 && a.count > most_zeros) d.fail(here, "has too many elements without data");
  if (a.bufferView < 0) return;
  if (a.count > d.view(a.bufferView, here).size()) d.fail(here, "reaches beyond its buffer view");
}

size_t element_count(const Document& d, int index, const std::string& pointer) {
  return find(d, index, pointer).count;
}

std::vector<float> read_floats(const Document& d, int index, int components,
                               const std::string& pointer) {
  std::vector<float> result(check(d, index, components, pointer));
  const auto width = static_cast<size_t>(components);
  read(d, index, components, pointer, [&](size_t i, int c, const Stored& from, size_t k) {
    result[i * width + static_cast<size_t>(c)] = from.number(k, c);
  });
  return result;
}

std::vector<uint32_t> read_integers(const Document& d, int index, int components,
                                    const std::string& pointer) {
  const tinygltf::Accessor& a = find(d, index, pointer);
  if (!is_unsigned(a.componentType) || a.normalized)
    d.fail(element("accessors", index), "must be unsigned integers for " + pointer);
  std::vector<uint32_t> result(check(d, index, components, pointer));
  const auto width = static_cast<size_t>(components);
  read(d, index, components, pointer, [&](size_t i, int c, const Stored& from, size_t k) {
    result[i * width + static_cast<size_t>(c)] = from.integer(k, c);
  });
  return result;
}

}  // namespace pssmlt::gltf
