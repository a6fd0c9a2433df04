// A glTF 2.0 file as it was read: tinygltf's model, and the places in it that messages name.
#pragma once

#include <tiny_gltf.h>

#include <set>
#include <span>
#include <string>

#include "core/base/error.h"

namespace pssmlt::gltf {

// "meshes[3]"
std::string element(const char* array, int index);

class Document {
 public:
  // Reads the file and the buffers it names. Throws Error on anything that tinygltf refuses, on an
  // extension that is required and not supported, and on JSON nested too deeply to be walked.
  Document(const std::string& path, std::string label);

  const tinygltf::Model& model() const { return model_; }
  const std::string& path() const { return path_; }
  // Different for every file imported into a scene.
  const std::string& label() const { return label_; }
  // All bytes that were read: the file, then the buffers beside it.
  std::span<const std::string_view> contents() const { return contents_; }
  // Extensions that the file uses and this program does not know.
  const std::set<std::string>& unknown_extensions() const { return unknown_; }

  // `pointer`: the place in the file, as "meshes[3].primitives[0]".
  Location at(const std::string& pointer) const;
  [[noreturn]] void fail(const std::string& pointer, const std::string& message) const;

  // An element of one of the model's arrays. Throws at `pointer` if the index is out of range.
  template <typename T>
  const T& get(const std::vector<T>& array, int index, const char* what,
               const std::string& pointer) const {
    if (index < 0 || static_cast<size_t>(index) >= array.size())
      fail(pointer, std::string(what) + "[" + std::to_string(index) + "] does not exist");
    return array[static_cast<size_t>(index)];
  }
  // The bytes of a buffer view, all of them inside its buffer.
  std::span<const unsigned char> view(int index, const std::string& pointer) const;

 private:
  void load();
  void check_extensions();

  std::string path_, label_, bytes_;
  std::vector<std::string_view> contents_;
  tinygltf::Model model_;
  std::set<std::string> unknown_;
};

// Members of an extension; the fallback where there is none of that name and type.
double number(const tinygltf::Value& object, const char* name, double fallback);
int integer(const tinygltf::Value& object, const char* name, int fallback);
// Numbers of an array, empty if there is none.
std::vector<double> numbers(const tinygltf::Value& object, const char* name);
// An extension by its name; null if it is not there.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& all, const char* name);

}  // namespace pssmlt::gltf
