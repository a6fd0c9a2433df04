// The container of the RGL's measured materials (.bsdf; Dupuy and Jakob 2018): named arrays of
// numbers. "tensor_file" and a zero byte, version 1.0, the number of fields; for each its name, its
// number of dimensions, type, place in the file and shape. Little endian.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace pssmlt {

class TensorFile {
 public:
  // Reads the directory and checks every field's extent against the file's size, so that nothing is
  // ever allocated that the file does not hold. Throws Error with a message that names no place.
  explicit TensorFile(const std::string& path);

  // True if a file's first bytes (12 at least) are those of a tensor file.
  static bool recognises(const std::string& start) {
    return start.starts_with(std::string("tensor_file\0", 12));
  }
  bool has(const std::string& name) const { return fields_.contains(name); }
  // The lengths of a field's dimensions, slowest first, none of them 0. Throws Error if the field
  // is missing or has another number of dimensions.
  const std::vector<uint64_t>& shape(const std::string& name, size_t dimensions) const;
  // `count` numbers of a field of 32-bit floats from `first` on. Throws Error on another type, on
  // numbers that are not finite, and if the file cannot be read.
  std::vector<float> floats(const std::string& name, uint64_t first, uint64_t count);
  std::vector<float> floats(const std::string& name);
  // The first of a field of bytes.
  uint8_t byte(const std::string& name);

 private:
  struct Field {
    uint8_t type = 0;
    uint64_t offset = 0, count = 0;  // [bytes], [numbers]
    std::vector<uint64_t> shape;
  };
  template <typename T>
  T next();
  void read_field();
  const Field& field(const std::string& name) const;

  std::ifstream in_;
  uint64_t size_ = 0;
  std::map<std::string, Field> fields_;
};

}  // namespace pssmlt
