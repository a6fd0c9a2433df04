// Loop subdivision of triangle meshes, with the limit surface and its normals.
//
// Source: C. Loop 1987, Smooth Subdivision Surfaces Based on Triangles; J. Warren and H. Weimer
// 2001, Subdivision Methods for Geometric Design (the weight 3/(8 n) at vertices of valence n > 3);
// Pharr and Humphreys 2010, Physically Based Rendering, 2nd ed., section 3.7. Vertices that are not
// shared lie on the boundary, which becomes a cubic spline.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/base/math.h"

namespace pssmlt {

struct SubdivisionMesh {
  std::vector<dvec3> positions;
  std::vector<glm::uvec3> triangles;
};

// "" if the mesh can be subdivided: indices in range, no edge shared by more than two triangles,
// all of one orientation, no vertex where two fans touch. Else what is wrong.
std::string check_for_subdivision(const SubdivisionMesh& mesh);

// One step: every triangle becomes four. Vertices that no triangle uses stay where they are.
SubdivisionMesh subdivide(const SubdivisionMesh& mesh);

// Where the vertices of the mesh are on the limit surface, and its unit normals there, on the side
// that the index order gives (zero where they are not defined).
struct LimitSurface {
  std::vector<dvec3> positions;
  std::vector<vec3> normals;
};
LimitSurface limit_surface(const SubdivisionMesh& mesh);

}  // namespace pssmlt
