// Small glTF files, written through tinygltf, and pictures of them.
#pragma once

#include <tiny_gltf.h>

#include <cstring>

#include "core/image/image.h"
#include "tests/support/render_text.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt::test {

class Asset {
 public:
  tinygltf::Model model;

  Asset() {
    model.asset.version = "2.0";
    model.buffers.emplace_back();
    model.scenes.emplace_back();
    model.defaultScene = 0;
  }
  // Bytes in the buffer, as a view of their own.
  int view(const void* bytes, size_t size) {
    auto& data = model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView v;
    v.buffer = 0;
    v.byteOffset = data.size();
    v.byteLength = size;
    const auto* const first = static_cast<const unsigned char*>(bytes);
    data.insert(data.end(), first, first + size);
    model.bufferViews.push_back(v);
    return static_cast<int>(model.bufferViews.size()) - 1;
  }
  // type: TINYGLTF_TYPE_...; component: TINYGLTF_COMPONENT_TYPE_...
  template <typename T>
  int accessor(const std::vector<T>& values, int type, int component, bool normalized = false) {
    tinygltf::Accessor a;
    a.bufferView = view(values.data(), values.size() * sizeof(T));
    a.byteOffset = 0;
    a.componentType = component;
    a.type = type;
    a.count = values.size() /
              static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    a.normalized = normalized;
    a.sparse.isSparse = false;
    model.accessors.push_back(a);
    return static_cast<int>(model.accessors.size()) - 1;
  }
  int vectors(const std::vector<float>& values, int type = TINYGLTF_TYPE_VEC3) {
    return accessor(values, type, TINYGLTF_COMPONENT_TYPE_FLOAT);
  }
  int indices(const std::vector<uint16_t>& values) {
    return accessor(values, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  }
  int mesh(const tinygltf::Primitive& primitive) {
    tinygltf::Mesh m;
    m.primitives.push_back(primitive);
    model.meshes.push_back(m);
    return static_cast<int>(model.meshes.size()) - 1;
  }
  int node(const tinygltf::Node& n, bool in_scene = true) {
    model.nodes.push_back(n);
    const int index = static_cast<int>(model.nodes.size()) - 1;
    if (in_scene) model.scenes[0].nodes.push_back(index);
    return index;
  }
  int place(int mesh_index) {
    tinygltf::Node n;
    n.mesh = mesh_index;
    return node(n);
  }
  int material(const tinygltf::Material& m) {
    model.materials.push_back(m);
    return static_cast<int>(model.materials.size()) - 1;
  }
  // The square [-1, 1]^2 at z = 0 facing +z, with texture coordinates, v growing downward.
  tinygltf::Primitive square(int material_index = -1) {
    tinygltf::Primitive p;
    p.mode = TINYGLTF_MODE_TRIANGLES;
    p.attributes["POSITION"] = vectors({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    p.attributes["TEXCOORD_0"] = vectors({0, 1, 1, 1, 1, 0, 0, 0}, TINYGLTF_TYPE_VEC2);
    p.indices = indices({0, 1, 2, 0, 2, 3});
    p.material = material_index;
    return p;
  }
  void use(const std::string& extension) { model.extensionsUsed.push_back(extension); }

  // Returns the path.
  std::string save(const std::string& name) const {
    const std::string path = (folder.path() / name).string();
    tinygltf::Model copy = model;
    if (copy.buffers[0].data.empty()) copy.buffers.clear();
    tinygltf::TinyGLTF writer;
    const bool binary = name.ends_with(".glb");
    if (!writer.WriteGltfSceneToFile(&copy, path, false, true, true, binary))
      throw std::runtime_error("cannot write " + path);
    return path;
  }
  TemporaryFolder folder;
};

// Values of extensions.
inline tinygltf::Value value(double v) { return tinygltf::Value(v); }
inline tinygltf::Value list(const std::vector<double>& numbers) {
  tinygltf::Value::Array array;
  for (const double v : numbers) array.emplace_back(v);
  return tinygltf::Value(array);
}
inline tinygltf::Value object(tinygltf::Value::Object members) {
  return tinygltf::Value(std::move(members));
}

// The trianglemesh that Asset::square becomes, in text.
inline const std::string square_text =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
    "\"point3 P\" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] \"point2 uv\" [ 0 0  1 0  1 1  0 1 ]\n";

// A view of the square, lit from the front and from all around.
inline const std::string stage = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Scale -1 1 1
LookAt 0.3 0.4 4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [ .3 .4 .5 ]
LightSource "point" "rgb I" [ 9 8 7 ] "point3 from" [ 1 2 3 ]
)";

inline Image picture(const std::string& scene, double spp = 16) {
  return render_text({.scene = scene, .spp = spp}, 1).image;
}
inline std::string importing(const std::string& path) { return "Import \"" + path + "\"\n"; }

// Sum of differences over the sum of values.
inline double difference(const Image& a, const Image& b) {
  if (a.data.size() != b.data.size()) return 1e30;
  double sum = 0.0, whole = 0.0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    sum += std::abs(static_cast<double>(a.data[i]) - static_cast<double>(b.data[i]));
    whole += std::abs(static_cast<double>(b.data[i]));
  }
  return whole > 0.0 ? sum / whole : sum;
}

}  // namespace pssmlt::test
