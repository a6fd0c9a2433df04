#include "core/measured/tensor_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>

#include "core/base/error.h"

namespace pssmlt {
namespace {

static_assert(std::endian::native == std::endian::little, "fields are read as they are");

constexpr uint32_t most_fields = 1000;
constexpr uint16_t most_dimensions = 8, longest_name = 1000;
constexpr uint8_t type_uint8 = 1, type_int8 = 2, type_float32 = 10;
// Bytes of the types 1 to 11: integers of 8 to 64 bits, unsigned and signed, and three floats.
constexpr std::array<uint64_t, 12> type_sizes = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};

}  // namespace

template <typename T>
T TensorFile::next() {
  T value;
  if (!in_.read(reinterpret_cast<char*>(&value), sizeof value))
    throw Error("the file ends within its list of fields");
  return value;
}

TensorFile::TensorFile(const std::string& path) : in_(path, std::ios::binary) {
  std::error_code failed;
  size_ = std::filesystem::file_size(path, failed);
  std::string start(12, ' ');
  if (failed || !in_.read(start.data(), 12) || !recognises(start))
    throw Error("this is no tensor file");
  const auto major = next<uint8_t>();
  const auto minor = next<uint8_t>();
  if (major != 1 || minor != 0)
    throw Error("tensor files of version " + std::to_string(major) + "." + std::to_string(minor) +
                " are not known");
  const auto count = next<uint32_t>();
  if (count > most_fields) throw Error(std::to_string(count) + " fields are too many");
  for (uint32_t i = 0; i < count; ++i) read_field();
}

void TensorFile::read_field() {
  const auto length = next<uint16_t>();
  if (length > longest_name) throw Error("a field's name is too long");
  std::string name(length, ' ');
  if (!in_.read(name.data(), length)) throw Error("the file ends within its list of fields");
  const auto dimensions = next<uint16_t>();
  Field field;
  field.type = next<uint8_t>();
  field.offset = next<uint64_t>();
  if (dimensions > most_dimensions) throw Error("field \"" + name + "\" has too many dimensions");
  if (field.type == 0 || field.type >= type_sizes.size())
    throw Error("field \"" + name + "\" has an unknown type");
  const uint64_t bytes = type_sizes[field.type];
  const uint64_t room = field.offset <= size_ ? (size_ - field.offset) / bytes : 0;
  field.count = 1;
  for (int i = 0; i < dimensions; ++i) {
    const auto extent = next<uint64_t>();
    if (extent == 0) throw Error("field \"" + name + "\" is empty");
    if (extent > room / field.count)
      throw Error("field \"" + name + "\" reaches beyond the end of the file");
    field.count *= extent;
    field.shape.push_back(extent);
  }
  if (!fields_.try_emplace(name, field).second)
    throw Error("field \"" + name + "\" is there twice");
}

const TensorFile::Field& TensorFile::field(const std::string& name) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) throw Error("field \"" + name + "\" is missing");
  return found->second;
}

const std::vector<uint64_t>& TensorFile::shape(const std::string& name, size_t dimensions) const {
  const Field& f = field(name);
  if (f.shape.size() != dimensions)
    throw Error("field \"" + name + "\" has " + std::to_string(f.shape.size()) +
                " dimensions, not " + std::to_string(dimensions));
  return f.shape;
}

std::vector<float> TensorFile::floats(const std::string& name, uint64_t first, uint64_t count) {
  const Field& f = field(name);
  if (f.type != type_float32) throw Error("field \"" + name + "\" does not hold 32-bit floats");
  if (first > f.count || count > f.count - first)
    throw Error("field \"" + name + "\" is too short");
  std::vector<float> values(count);
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(f.offset + first * sizeof(float)));
  if (!in_.read(reinterpret_cast<char*>(values.data()),
                static_cast<std::streamsize>(count * sizeof(float))))
    throw Error("field \"" + name + "\" cannot be read");
  for (const float v : values)
    if (!std::isfinite(v)) throw Error("field \"" + name + "\" has a value that is not finite");
  return values;
}

std::vector<float> TensorFile::floats(const std::string& name) {
  return floats(name, 0, field(name).count);
}

uint8_t TensorFile::byte(const std::string& name) {
  const Field& f = field(name);
  if ((f.type != type_uint8 && f.type != type_int8) || f.count == 0)
    throw Error("field \"" + name + "\" does not hold bytes");
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(f.offset));
  return next<uint8_t>();
}

}  // namespace pssmlt
