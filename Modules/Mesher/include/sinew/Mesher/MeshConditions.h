#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <vector>

namespace sinew {

/// How often a mesh violates the three conditions of Teran et al. 2005, section 6: T1 (manifold boundary),
/// T2 (no tet with four boundary nodes), T3 (no interior edge between two boundary nodes). All 0 in a good
/// mesh.
struct MeshConditions {
  std::int64_t nonmanifoldEdges = 0;           ///< T1: boundary edges without exactly two boundary triangles
  std::int64_t nonmanifoldNodes = 0;           ///< T1: boundary nodes whose triangles form no single fan
  std::int64_t tetsWithFourBoundaryNodes = 0;  ///< T2
  std::int64_t interiorEdgesBetweenBoundaryNodes = 0;  ///< T3
  std::int64_t interiorFacesWithThreeBoundaryNodes = 0;
  bool good() const {
    return nonmanifoldEdges + nonmanifoldNodes + tetsWithFourBoundaryNodes +
               interiorEdgesBetweenBoundaryNodes + interiorFacesWithThreeBoundaryNodes ==
           0;
  }
};
/// Cost: O(tets log tets).
MeshConditions meshConditions(const TetMesh& mesh);

/// The boundary triangles, counterclockwise from outside, in the order of the tets.
std::vector<Triangle> boundaryTriangles(const TetMesh& mesh);

/// Shape of a mesh as a space.
struct MeshTopology {
  std::int64_t components = 0;           ///< pieces connected by faces
  std::int64_t boundaryComponents = 0;   ///< closed surfaces
  std::int64_t eulerCharacteristic = 0;  ///< V - E + F of the boundary; 2 per sphere, 0 per torus
};
MeshTopology meshTopology(const TetMesh& mesh);

}  // namespace sinew
