// The tree of nodes, walked once: what stands where.
#pragma once

#include <vector>

#include "core/base/transform.h"
#include "modules/gltf/document.h"

namespace pssmlt::gltf {

struct PlacedNode {
  int node = 0;
  dmat4 world{1.0};  // the node's space to that of the file
  bool copy =
      false;  // one more instance of the node's mesh, nothing else (EXT_mesh_gpu_instancing)
};

// All nodes of the file's scene (of its first one if it names none, of all roots if there is no
// scene), parents first. Throws Error if a node is below two others or below itself.
std::vector<PlacedNode> walk_nodes(const Document& document);
// Matrices that take a skin's mesh to the world, one a joint. Joints that are not placed stay at
// rest.
std::vector<dmat4> joint_matrices(const Document& document, int skin,
                                  const std::vector<PlacedNode>& nodes);

}  // namespace pssmlt::gltf
