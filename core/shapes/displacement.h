// Meshes cut into small triangles whose vertices are moved along the normals by a texture.
//
// Source: Cook 1984, "Shade Trees" (displacement); pbrt-v4's "displacement" of meshes for the
// parameters. Edges are halved until none is longer than asked for. Whether an edge is halved,
// where, and how far a vertex moves follows from positions alone: triangles that share an edge, by
// index or only by place (seams of texture coordinates), stay joined.
#pragma once

#include "core/shapes/mesh_shape.h"
#include "core/texture.h"

namespace pssmlt {

struct Displacement {
  std::shared_ptr<const Texture<float>> height;  // [m in the mesh's space], along the normal
  float edge_length = 1.f;                       // [m in render space] at most, before moving
};

// `mesh` in its own space, with indices in range; `p`: its transform leads to render space.
// Vertices without a normal get the mean of their triangles', by area. The result has the normals
// of the moved surface. Throws Error at p's parameters if that takes more than 2^26 triangles, or
// if the texture gives a value that is not finite.
MeshData displace(MeshData mesh, const Displacement& displacement, const Parameters& p);

}  // namespace pssmlt
