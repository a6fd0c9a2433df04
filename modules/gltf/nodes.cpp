#include "modules/gltf/nodes.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "modules/gltf/accessor.h"

namespace pssmlt::gltf {
namespace {

// Three, four (x y z w) and three numbers, each may be missing.
template <typename T>
dmat4 composed(std::span<const T> translation, std::span<const T> rotation,
               std::span<const T> scale) {
  dmat4 m(1.0);
  if (translation.size() == 3) m[3] = {translation[0], translation[1], translation[2], 1.0};
  if (rotation.size() == 4) {
    const glm::dquat q(rotation[3], rotation[0], rotation[1], rotation[2]);
    // Files have few digits.
    if (glm::length(q) > 0.0) m = m * glm::mat4_cast(glm::normalize(q));
  }
  if (scale.size() == 3)
    for (int i = 0; i < 3; ++i) m[i] *= static_cast<double>(scale[static_cast<size_t>(i)]);
  return m;
}

dmat4 local_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  return composed<double>(node.translation, node.rotation, node.scale);
}

// The instances of a node's mesh; one that is not moved if the extension is not there.
std::vector<dmat4> instances(const Document& document, int node) {
  const std::string pointer = element("nodes", node) + ".extensions.EXT_mesh_gpu_instancing";
  const tinygltf::Value* const v = extension(
      document.model().nodes[static_cast<size_t>(node)].extensions, "EXT_mesh_gpu_instancing");
  if (!v || !v->IsObject() || !v->Has("attributes")) return {dmat4(1.0)};
  const tinygltf::Value& attributes = v->Get("attributes");
  size_t count = 0;
  const auto read = [&](const char* name, int components) {
    const int accessor = integer(attributes, name, -1);
    std::vector<float> values;
    if (accessor < 0) return values;
    values = read_floats(document, accessor, components, pointer);
    const size_t found = values.size() / static_cast<size_t>(components);
    if (count != 0 && found != count) document.fail(pointer, "has attributes of different lengths");
    count = found;
    return values;
  };
  const std::vector<float> moved = read("TRANSLATION", 3), turned = read("ROTATION", 4),
                           scaled = read("SCALE", 3);
  std::vector<dmat4> result;
  for (size_t i = 0; i < count; ++i) {
    const auto part = [i](const std::vector<float>& values, size_t n) {
      return values.empty() ? std::span<const float>()
                            : std::span<const float>(values).subspan(n * i, n);
    };
    result.push_back(composed<float>(part(moved, 3), part(turned, 4), part(scaled, 3)));
  }
  return result;
}

std::vector<int> roots(const Document& document) {
  const tinygltf::Model& model = document.model();
  if (!model.scenes.empty()) {
    const int wanted = std::max(model.defaultScene, 0);
    return document.get(model.scenes, wanted, "scenes", "scene").nodes;
  }
  std::vector<bool> is_child(model.nodes.size());
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<size_t>(child) < is_child.size())
        is_child[static_cast<size_t>(child)] = true;
  std::vector<int> found;
  for (size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) found.push_back(static_cast<int>(i));
  return found;
}

}  // namespace

std::vector<PlacedNode> walk_nodes(const Document& document) {
  const tinygltf::Model& model = document.model();
  std::vector<bool> met(model.nodes.size());
  std::vector<PlacedNode> nodes;
  // By hand: a chain of nodes may be longer than the stack is deep.
  std::vector<PlacedNode> open;
  const auto push = [&](const std::vector<int>& children, const dmat4& parent,
                        const std::string& pointer) {
    for (size_t i = children.size(); i > 0; --i) {
      const int child = children[i - 1];
      const tinygltf::Node& node = document.get(model.nodes, child, "nodes", pointer);
      if (met[static_cast<size_t>(child)])
        document.fail(element("nodes", child), "is below two nodes, or below itself");
      met[static_cast<size_t>(child)] = true;
      open.push_back({child, parent * local_matrix(node)});
    }
  };
  push(roots(document), dmat4(1.0), "scenes");
  while (!open.empty()) {
    const PlacedNode placed = open.back();
    open.pop_back();
    bool copy = false;
    for (const dmat4& instance : instances(document, placed.node)) {
      nodes.push_back({placed.node, placed.world * instance, copy});
      copy = true;
    }
    push(model.nodes[static_cast<size_t>(placed.node)].children, placed.world,
         element("nodes", placed.node));
  }
  return nodes;
}

std::vector<dmat4> joint_matrices(const Document& document, int index,
                                  const std::vector<PlacedNode>& nodes) {
  const std::string pointer = element("skins", index);
  const tinygltf::Skin& skin = document.get(document.model().skins, index, "skins", "nodes");
  std::vector<dmat4> result(skin.joints.size(), dmat4(1.0));
  if (skin.inverseBindMatrices >= 0) {
    const std::vector<float> numbers =
        read_floats(document, skin.inverseBindMatrices, 16, pointer + ".inverseBindMatrices");
    if (numbers.size() < 16 * result.size())
      document.fail(pointer + ".inverseBindMatrices", "has fewer matrices than there are joints");
    for (size_t i = 0; i < result.size(); ++i)
      result[i] = dmat4(glm::make_mat4(numbers.data() + 16 * i));
  }
  std::vector<const dmat4*> world(document.model().nodes.size());
  for (const PlacedNode& n : nodes) world[static_cast<size_t>(n.node)] = &n.world;
  for (size_t i = 0; i < result.size(); ++i) {
    document.get(document.model().nodes, skin.joints[i], "nodes", pointer + ".joints");
    if (const dmat4* const m = world[static_cast<size_t>(skin.joints[i])])
      result[i] = *m * result[i];
  }
  return result;
}

}  // namespace pssmlt::gltf
