// Reads triangle meshes from PLY files: ASCII, binary of either byte order, and any of them
// gzipped.
//
// Format: G. Turk, The PLY Polygon File Format. Vertex properties used: x y z, nx ny nz, and u v or
// s t (also texture_u ..., texture_s ...); of faces the list vertex_indices (vertex_index).
// Polygons become fans of triangles; everything else in the file is skipped.
#pragma once

#include <string>

#include "core/base/error.h"
#include "core/shapes/mesh_shape.h"

namespace pssmlt {

// Throws Error at `where` with the file's name if it cannot be read, is no PLY file, is truncated
// or lacks vertices or faces.
MeshData read_ply(const std::string& path, const Location& where);
// The same for a file that is in memory already; `path` is for messages.
MeshData parse_ply(const std::string& text, const std::string& path, const Location& where);

}  // namespace pssmlt
