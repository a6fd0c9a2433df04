// The meshes of a glTF 2.0 file (.gltf or .glb), with the transforms of its nodes, merged into one.
//
// Source: Khronos Group 2021, glTF 2.0 Specification. Taken: the nodes of the default scene (or of
// all scenes if none is the default), triangles, strips and fans with positions, normals and the
// first texture coordinates, whose v is turned over to grow upward. Left out: points and lines,
// skins, morph targets, materials, lights and cameras; images are not decoded.
#include <tiny_gltf.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/base/log.h"
#include "core/plugin/plugin.h"
#include "core/shapes/mesh_shape.h"

namespace pssmlt {
namespace {

// Elements of an accessor as doubles; every access is checked against the buffer.
class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<size_t>(index) >= model.accessors.size())
      throw std::runtime_error("accessor " + std::to_string(index) + " does not exist");
    const tinygltf::Accessor& a = model.accessors[static_cast<size_t>(index)];
    if (a.sparse.isSparse) throw std::runtime_error("sparse accessors are not supported yet");
    if (a.bufferView < 0 || static_cast<size_t>(a.bufferView) >= model.bufferViews.size())
      throw std::runtime_error("accessor " + std::to_string(index) + " has no buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(a.bufferView)];
    if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= model.buffers.size())
      throw std::runtime_error("a buffer view names a buffer that does not exist");
    const auto& bytes = model.buffers[static_cast<size_t>(view.buffer)].data;
    components_ = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
    if (components_ <= 0 || size <= 0) throw std::runtime_error("an accessor has an unknown type");
    type_ = a.componentType;
    normalized_ = a.normalized;
    component_size_ = static_cast<size_t>(size);
    const size_t element = component_size_ * static_cast<size_t>(components_);
    stride_ = view.byteStride != 0 ? view.byteStride : element;
    count_ = a.count;
    const size_t offset = view.byteOffset + a.byteOffset;
    if (offset > bytes.size() || element > bytes.size() - offset ||
        (count_ > 0 && (count_ - 1) > (bytes.size() - offset - element) / stride_))
      throw std::runtime_error("accessor " + std::to_string(index) + " reaches beyond its buffer");
    data_ = bytes.data() + offset;
  }
  size_t count() const { return count_; }
  int components() const { return components_; }
  double get(size_t i, int component) const {
    const unsigned char* const p =
        data_ + i * stride_ + static_cast<size_t>(component) * component_size_;
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return integer<int8_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return integer<uint8_t>(p);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return integer<int16_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return integer<uint16_t>(p);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<uint32_t>(p);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return static_cast<double>(load<float>(p));
      default:
        throw std::runtime_error("an accessor has an unknown component type");
    }
  }

 private:
  template <typename T>
  static T load(const unsigned char* p) {
    T v;
    std::memcpy(&v, p, sizeof(T));
    return v;
  }
  template <typename T>
  double integer(const unsigned char* p) const {
    const double v = load<T>(p);
    return normalized_ ? std::max(-1.0, v / std::numeric_limits<T>::max()) : v;
  }
  const unsigned char* data_ = nullptr;
  size_t count_ = 0, stride_ = 0, component_size_ = 0;
  int components_ = 0, type_ = 0;
  bool normalized_ = false;
};

dmat4 node_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  dmat4 m(1.0);
  if (node.translation.size() == 3)
    m[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  if (node.rotation.size() == 4)
    m = m * glm::mat4_cast(
                glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
  if (node.scale.size() == 3)
    for (int i = 0; i < 3; ++i) m[i] *= node.scale[static_cast<size_t>(i)];
  return m;
}

class Importer {
 public:
  explicit Importer(const tinygltf::Model& model) : model_(model) {}

  MeshData import() {
    const auto visit_scene = [this](const tinygltf::Scene& scene) {
      for (const int node : scene.nodes) visit(node, dmat4(1.0), 0);
    };
    if (model_.defaultScene >= 0 && static_cast<size_t>(model_.defaultScene) < model_.scenes.size())
      visit_scene(model_.scenes[static_cast<size_t>(model_.defaultScene)]);
    else
      for (const tinygltf::Scene& scene : model_.scenes) visit_scene(scene);
    if (data_.mesh.triangles.empty()) throw std::runtime_error("its scene has no triangles");
    if (!has_normals_) data_.mesh.normals.clear();
    if (!has_uvs_) data_.mesh.uvs.clear();
    return std::move(data_);
  }
  size_t skipped() const { return skipped_; }

 private:
  void visit(int index, const dmat4& parent, size_t depth) {
    if (index < 0 || static_cast<size_t>(index) >= model_.nodes.size())
      throw std::runtime_error("node " + std::to_string(index) + " does not exist");
    if (depth > model_.nodes.size()) throw std::runtime_error("its nodes form a circle");
    const tinygltf::Node& node = model_.nodes[static_cast<size_t>(index)];
    const dmat4 m = parent * node_matrix(node);
    if (node.mesh >= 0) {
      if (static_cast<size_t>(node.mesh) >= model_.meshes.size())
        throw std::runtime_error("mesh " + std::to_string(node.mesh) + " does not exist");
      // A node scaled to nothing shows nothing.
      if (Transform::is_invertible(m))
        for (const auto& p : model_.meshes[static_cast<size_t>(node.mesh)].primitives)
          primitive(p, Transform(m));
    }
    for (const int child : node.children) visit(child, m, depth + 1);
  }

  void primitive(const tinygltf::Primitive& p, const Transform& to_object) {
    const int mode = p.mode < 0 ? TINYGLTF_MODE_TRIANGLES : p.mode;
    const auto positions = p.attributes.find("POSITION");
    if (mode < TINYGLTF_MODE_TRIANGLES || positions == p.attributes.end()) {
      ++skipped_;
      return;
    }
    const auto first = static_cast<uint32_t>(data_.mesh.positions.size());
    const AccessorReader reader(model_, positions->second);
    if (reader.components() != 3) throw std::runtime_error("positions have not three components");
    if (reader.count() > 0xFFFFFFFFu - first) throw std::runtime_error("too many vertices");
    for (size_t i = 0; i < reader.count(); ++i)
      data_.mesh.positions.push_back(
          vec3(to_object.point(dvec3(reader.get(i, 0), reader.get(i, 1), reader.get(i, 2)))));
    normals(p, to_object, reader.count());
    uvs(p, reader.count());
    triangles(p, mode, first, reader.count(), to_object.swaps_handedness());
  }

  // Zero normals and coordinates stand for those that are not given.
  void normals(const tinygltf::Primitive& p, const Transform& to_object, size_t count) {
    std::vector<vec3>& out = data_.mesh.normals;
    const auto given = p.attributes.find("NORMAL");
    if (given == p.attributes.end()) {
      out.resize(out.size() + count, vec3(0.f));
      return;
    }
    const AccessorReader reader(model_, given->second);
    if (reader.count() != count || reader.components() != 3)
      throw std::runtime_error("normals do not fit the positions");
    has_normals_ = true;
    for (size_t i = 0; i < count; ++i)
      out.push_back(
          vec3(to_object.normal(dvec3(reader.get(i, 0), reader.get(i, 1), reader.get(i, 2)))));
  }
  void uvs(const tinygltf::Primitive& p, size_t count) {
    std::vector<vec2>& out = data_.mesh.uvs;
    const auto given = p.attributes.find("TEXCOORD_0");
    if (given == p.attributes.end()) {
      out.resize(out.size() + count, vec2(0.f));
      return;
    }
    const AccessorReader reader(model_, given->second);
    if (reader.count() != count || reader.components() != 2)
      throw std::runtime_error("texture coordinates do not fit the positions");
    has_uvs_ = true;
    for (size_t i = 0; i < count; ++i) out.emplace_back(reader.get(i, 0), 1.0 - reader.get(i, 1));
  }

  void triangles(const tinygltf::Primitive& p, int mode, uint32_t first, size_t vertices,
                 bool mirrored) {
    std::vector<uint32_t> order;
    if (p.indices >= 0) {
      const AccessorReader reader(model_, p.indices);
      for (size_t i = 0; i < reader.count(); ++i) {
        const double index = reader.get(i, 0);
        if (!(index >= 0.0 && index < static_cast<double>(vertices)))
          throw std::runtime_error("an index is out of range");
        order.push_back(first + static_cast<uint32_t>(index));
      }
    } else {
      for (size_t i = 0; i < vertices; ++i) order.push_back(first + static_cast<uint32_t>(i));
    }
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      // A mirroring node keeps its outside.
      if (mirrored) std::swap(b, c);
      data_.mesh.triangles.emplace_back(a, b, c);
    };
    const size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (size_t i = 0; i + 3 <= order.size(); i += step) {
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
        add(order[0], order[i + 1], order[i + 2]);
      else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1)
        add(order[i], order[i + 2], order[i + 1]);
      else
        add(order[i], order[i + 1], order[i + 2]);
    }
  }

  const tinygltf::Model& model_;
  MeshData data_;
  bool has_normals_ = false, has_uvs_ = false;
  size_t skipped_ = 0;
};

bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                  const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model load(const std::string& file) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const bool binary = file.ends_with(".glb") || file.ends_with(".GLB");
  const bool loaded = binary ? loader.LoadBinaryFromFile(&model, &error, &warning, file)
                             : loader.LoadASCIIFromFile(&model, &error, &warning, file);
  while (!error.empty() && error.back() == '\n') error.pop_back();
  if (!loaded) throw std::runtime_error(error.empty() ? "it cannot be read" : error);
  for (const std::string& extension : model.extensionsRequired)
    if (extension != "KHR_mesh_quantization" && !extension.starts_with("KHR_materials") &&
        !extension.starts_with("KHR_texture"))
      throw std::runtime_error("it requires the extension " + extension +
                               ", which is not supported");
  return model;
}

MeshData read(Parameters& p) {
  const std::string file = p.file("filename", "The glTF file, .gltf or .glb.");
  if (p.describing()) return {};
  if (file.empty()) p.fail("filename", "\"filename\" is missing");
  try {
    const tinygltf::Model model = load(file);
    Importer importer(model);
    MeshData data = importer.import();
    if (importer.skipped() != 0)
      log_info("glTF file '" + file + "': " + std::to_string(importer.skipped()) +
               " primitives without triangles left out");
    return data;
  } catch (const std::exception& e) {
    p.fail("filename", "glTF file '" + file + "': " + e.what());
  }
}

class GltfShape final : public MeshShape {
 public:
  static constexpr const char* summary = "The meshes of a glTF file as one shape";
  explicit GltfShape(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "gltf", pssmlt::GltfShape)
