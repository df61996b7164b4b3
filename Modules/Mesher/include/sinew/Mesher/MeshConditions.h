#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <vector>

namespace sinew {

/// What borders a mesh; found once, for all who look at it.
struct MeshBoundary {
  std::vector<Triangle> triangles;   ///< counterclockwise from outside, in the order of the tets
  std::vector<bool> isBoundary;      ///< [4 t + f]: no other tet has face f of tet t
  std::int64_t facesOfManyTets = 0;  ///< faces that three or more tets share
  std::int64_t components = 0;       ///< pieces of the mesh connected by faces
};
/// Cost: O(tets log valence).
MeshBoundary meshBoundary(const TetMesh& mesh);

/// How often a mesh violates the three conditions of Teran et al. 2005, section 6: T1 (manifold boundary),
/// T2 (no tet with four boundary nodes), T3 (no interior edge between two boundary nodes). All 0 in a good
/// mesh.
struct MeshConditions {
  std::int64_t facesOfManyTets = 0;            ///< faces that three or more tets share
  std::int64_t nonmanifoldEdges = 0;           ///< T1: boundary edges without exactly two boundary triangles
  std::int64_t nonmanifoldNodes = 0;           ///< T1: boundary nodes whose triangles form no single fan
  std::int64_t tetsWithFourBoundaryNodes = 0;  ///< T2
  std::int64_t interiorEdgesBetweenBoundaryNodes = 0;  ///< T3
  std::int64_t interiorFacesWithThreeBoundaryNodes = 0;
  bool good() const {
    return facesOfManyTets + nonmanifoldEdges + nonmanifoldNodes + tetsWithFourBoundaryNodes +
               interiorEdgesBetweenBoundaryNodes + interiorFacesWithThreeBoundaryNodes ==
           0;
  }
};
/// Cost: O(tets).
MeshConditions meshConditions(const TetMesh& mesh, const MeshBoundary& boundary);
inline MeshConditions meshConditions(const TetMesh& mesh) { return meshConditions(mesh, meshBoundary(mesh)); }

/// Shape of a mesh as a space.
struct MeshTopology {
  std::int64_t components = 0;           ///< pieces connected by faces
  std::int64_t boundaryComponents = 0;   ///< closed surfaces
  std::int64_t eulerCharacteristic = 0;  ///< V - E + F of the boundary; 2 per sphere, 0 per torus
};
MeshTopology meshTopology(const TetMesh& mesh, const MeshBoundary& boundary);
inline MeshTopology meshTopology(const TetMesh& mesh) { return meshTopology(mesh, meshBoundary(mesh)); }

}  // namespace sinew
