#include "modules/gltf/attributes.h"

#include <numeric>

#include "modules/gltf/accessor.h"

namespace pssmlt::gltf {

Attributes::Attributes(const Document& document, const tinygltf::Primitive& primitive,
                       const std::string& pointer)
    : document_(document), primitive_(primitive), pointer_(pointer) {
  const tinygltf::Value* const packed =
      extension(primitive.extensions, "KHR_draco_mesh_compression");
  if (packed && has_draco()) decompress(*packed);
  if (!has("POSITION")) return;
  vertices_ = draco_ ? draco_->vertices
                     : element_count(document, accessor("POSITION"), pointer + ".attributes");
  if (vertices_ > 0x7FFFFFFFu) document.fail(pointer, "has too many vertices");
  // Before anything is made that has an element a vertex.
  if (!draco_) check_backed(document, accessor("POSITION"), pointer + ".attributes");
}

void Attributes::decompress(const tinygltf::Value& packed) {
  const std::string here = pointer_ + ".extensions.KHR_draco_mesh_compression";
  std::map<std::string, int> wanted;
  if (packed.IsObject() && packed.Has("attributes") && packed.Get("attributes").IsObject())
    for (const std::string& name : packed.Get("attributes").Keys())
      wanted[name] = integer(packed.Get("attributes"), name.c_str(), -1);
  try {
    draco_ = std::make_unique<DracoMesh>(
        decode_draco(document_.view(integer(packed, "bufferView", -1), here), wanted));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    document_.fail(here, e.what());
  }
}

bool Attributes::has(const std::string& name) const {
  return (draco_ && draco_->attributes.contains(name)) || primitive_.attributes.contains(name);
}

int Attributes::components(const std::string& name) const {
  if (draco_ && draco_->attributes.contains(name)) return draco_->attributes.at(name).components;
  return component_count(document_, accessor(name), pointer_ + ".attributes." + name);
}

std::vector<float> Attributes::checked(std::vector<float> values, int components,
                                       const std::string& name) const {
  if (values.size() != vertices_ * static_cast<size_t>(components))
    document_.fail(pointer_ + "." + name, "has not as many elements as there are positions");
  return values;
}

std::vector<float> Attributes::floats(const std::string& name, int components) const {
  const std::string place = "attributes." + name;
  if (draco_ && draco_->attributes.contains(name)) {
    const DracoAttribute& a = draco_->attributes.at(name);
    if (a.components != components)
      document_.fail(pointer_ + "." + place, "has " + std::to_string(a.components) + " components");
    return checked(a.values, components, place);
  }
  return checked(read_floats(document_, accessor(name), components, pointer_ + "." + place),
                 components, place);
}

std::vector<float> Attributes::target(int accessor, const std::string& name) const {
  const std::string place = "targets." + name;
  return checked(read_floats(document_, accessor, 3, pointer_ + "." + place), 3, place);
}

std::vector<uint32_t> Attributes::indices() const {
  std::vector<uint32_t> result;
  if (draco_) {
    result = draco_->indices;
  } else if (primitive_.indices >= 0) {
    result = read_integers(document_, primitive_.indices, 1, pointer_ + ".indices");
  } else {
    result.resize(vertices_);
    std::iota(result.begin(), result.end(), 0u);
  }
  for (const uint32_t i : result)
    if (i >= vertices_)
      document_.fail(pointer_ + ".indices", "index " + std::to_string(i) +
                                                " is out of range: there are " +
                                                std::to_string(vertices_) + " vertices");
  return result;
}

}  // namespace pssmlt::gltf
