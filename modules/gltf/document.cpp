#include "modules/gltf/document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "modules/gltf/draco.h"

namespace pssmlt::gltf {
namespace {
namespace fs = std::filesystem;

constexpr const char* draco = "KHR_draco_mesh_compression";

constexpr std::array<std::string_view, 16> supported = {"KHR_lights_punctual",
                                                        "KHR_materials_anisotropy",
                                                        "KHR_materials_clearcoat",
                                                        "KHR_materials_dispersion",
                                                        "KHR_materials_emissive_strength",
                                                        "KHR_materials_ior",
                                                        "KHR_materials_sheen",
                                                        "KHR_materials_specular",
                                                        "KHR_materials_transmission",
                                                        "KHR_materials_unlit",
                                                        "KHR_materials_volume",
                                                        "KHR_mesh_quantization",
                                                        "KHR_texture_transform",
                                                        "EXT_mesh_gpu_instancing",
                                                        "EXT_texture_webp",
                                                        "KHR_draco_mesh_compression"};

// Deeper than any file that is not made to break its readers, which recurse.
constexpr int deepest = 128;

bool is_too_deep(std::string_view json) {
  int depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

uint32_t word(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

// The JSON of a binary file: its first chunk.
std::string_view json_chunk(std::string_view bytes) {
  constexpr size_t header = 20;
  if (bytes.size() < header) throw std::runtime_error("the file is truncated");
  if (word(bytes, 4) != 2) throw std::runtime_error("its version is not 2");
  if (word(bytes, 8) > bytes.size()) throw std::runtime_error("the file is truncated");
  const size_t length = word(bytes, 12);
  if (length > bytes.size() - header) throw std::runtime_error("its first chunk is truncated");
  return bytes.substr(header, length);
}

// tinygltf refuses indices without data, which compressed meshes have: they are left out.
void leave_out_indices(nlohmann::json& file) {
  const auto& accessors = file["accessors"];
  for (auto& mesh : file["meshes"]) {
    for (auto& primitive : mesh["primitives"]) {
      if (!primitive.contains("extensions") || !primitive["extensions"].contains(draco)) continue;
      const auto index = primitive.value("indices", accessors.size());
      if (index < accessors.size() && !accessors[index].contains("bufferView"))
        primitive.erase("indices");
    }
  }
}

// The file with other JSON of its own kind.
std::string with_json(const std::string& bytes, std::string_view old, std::string text) {
  if (old.size() == bytes.size()) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const size_t rest = static_cast<size_t>(old.data() - bytes.data()) + old.size();
  std::string result = bytes.substr(0, 20) + text + bytes.substr(rest);
  const auto put = [&](size_t at, size_t value) {
    const auto word = static_cast<uint32_t>(value);
    std::memcpy(result.data() + at, &word, 4);
  };
  put(8, result.size());
  put(12, text.size());
  return result;
}

// Images are decoded by those who use them. Those of data URIs exist here alone.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && image->uri.empty() && size > 0)
    image->image.assign(bytes, bytes + size);
  return true;
}

std::string on_one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at))
    text.replace(at, 1, "; ");
  return text;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::string element(const char* array, int index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

Document::Document(const std::string& path, std::string label)
    : path_(path), label_(std::move(label)) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path, ignored)) throw Error("cannot read '" + path + "'");
  bytes_.assign(std::istreambuf_iterator<char>(file), {});
  try {
    load();
  } catch (const std::bad_alloc&) {
    throw Error(path_ + ": it is too large for the memory");
  } catch (const std::exception& e) {
    throw Error(path_ + ": " + on_one_line(e.what()));
  }
  contents_.push_back(bytes_);
  for (const tinygltf::Buffer& buffer : model_.buffers)
    contents_.emplace_back(reinterpret_cast<const char*>(buffer.data.data()), buffer.data.size());
  check_extensions();
}

void Document::load() {
  if (bytes_.empty()) throw std::runtime_error("the file is empty");
  if (bytes_.size() > 0xFFFFFFFFu) throw std::runtime_error("files above 4 GB are not supported");
  const bool binary = bytes_.starts_with("glTF");
  const std::string_view json = binary ? json_chunk(bytes_) : std::string_view(bytes_);
  if (is_too_deep(json)) throw std::runtime_error("its JSON is nested too deeply");
  std::string changed;
  if (json.find(draco) != std::string_view::npos) {
    auto file = nlohmann::json::parse(json);
    leave_out_indices(file);
    changed = with_json(bytes_, json, file.dump());
  }
  const std::string& bytes = changed.empty() ? bytes_ : changed;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  std::string error, warning;
  const std::string folder = fs::path(path_).parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool loaded =
      binary ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()),
                                           size, folder)
             : loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(), size, folder);
  if (!loaded) throw std::runtime_error(error.empty() ? "it is not a glTF 2.0 file" : error);
}

void Document::check_extensions() {
  for (const std::string& name : model_.extensionsUsed)
    if (std::ranges::find(supported, name) == supported.end()) unknown_.insert(name);
  for (size_t i = 0; i < model_.extensionsRequired.size(); ++i) {
    const std::string& name = model_.extensionsRequired[i];
    const std::string pointer = element("extensionsRequired", static_cast<int>(i));
    if (std::ranges::find(supported, name) == supported.end())
      fail(pointer, "the extension " + name + " is not supported");
    if (name == draco && !has_draco())
      fail(pointer, "the extension " + name +
                        " needs the module gltf_draco, which was built without libdraco");
  }
  if (contains(model_.extensionsUsed, draco) && !has_draco()) unknown_.insert(draco);
}

Location Document::at(const std::string& pointer) const {
  return {std::make_shared<const std::string>(path_ + ": " + pointer), 0, 0};
}

void Document::fail(const std::string& pointer, const std::string& message) const {
  throw Error(at(pointer), message);
}

std::span<const unsigned char> Document::view(int index, const std::string& pointer) const {
  const tinygltf::BufferView& view = get(model_.bufferViews, index, "bufferViews", pointer);
  const std::string here = element("bufferViews", index);
  const auto& bytes = get(model_.buffers, view.buffer, "buffers", here).data;
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
    fail(here, "reaches beyond its buffer");
  return {bytes.data() + view.byteOffset, view.byteLength};
}

double number(const tinygltf::Value& object, const char* name, double fallback) {
  if (!object.IsObject() || !object.Has(name) || !object.Get(name).IsNumber()) return fallback;
  return object.Get(name).GetNumberAsDouble();
}

int integer(const tinygltf::Value& object, const char* name, int fallback) {
  if (!object.IsObject() || !object.Has(name) || !object.Get(name).IsNumber()) return fallback;
  return object.Get(name).GetNumberAsInt();
}

std::vector<double> numbers(const tinygltf::Value& object, const char* name) {
  std::vector<double> found;
  if (!object.IsObject() || !object.Has(name) || !object.Get(name).IsArray()) return found;
  const tinygltf::Value& array = object.Get(name);
  for (size_t i = 0; i < array.ArrayLen(); ++i) {
    const tinygltf::Value& v = array.Get(static_cast<int>(i));
    found.push_back(v.IsNumber() ? v.GetNumberAsDouble() : 0.0);
  }
  return found;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& all, const char* name) {
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace pssmlt::gltf
