// Primitives of meshes as triangles: what a shape "trianglemesh" is given.
#pragma once

#include <array>
#include <optional>

#include "core/scene/parameters.h"
#include "core/shape.h"
#include "modules/gltf/document.h"

namespace pssmlt::gltf {

// What the material asks of a mesh.
struct MeshNeeds {
  std::array<int, 2> uv_sets = {-1, -1};  // of the first and second coordinates, -1: not wanted
  bool colors = false, tangents = false;
};

// How the mesh is bent where it stands: weights of morph targets, and for skins the matrix of each
// joint, that takes the mesh to the world.
struct Pose {
  std::vector<double> weights;
  std::vector<dmat4> joints;  // empty: no skin
};

struct MeshPiece {
  ParameterSet parameters;
  Bounds bounds;  // in the mesh's own space, with a skin in the world
};

// nullopt if the primitive shows no triangle: points, lines, nothing.
std::optional<MeshPiece> read_primitive(const Document& document, int mesh, size_t primitive,
                                        const MeshNeeds& needs, const Pose& pose);

// "meshes[2].primitives[0]"
std::string primitive_pointer(int mesh, size_t primitive);

}  // namespace pssmlt::gltf
