#pragma once

#include "sinew/MeshIO/QuadraticMesh.h"
#include "sinew/Mesher/TetMesh.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew {

/// A named value, or several, for every tet, or for every node.
struct MeshArray {
  std::string name;
  std::vector<float> values;
  int components = 1;  ///< of each; three are a vector along the axes of LPS
};
struct MeshArrays {
  std::vector<MeshArray> cells;   ///< of each tet; the names `labels`, `material` and `RGB` are taken
  std::vector<MeshArray> points;  ///< of each node
};

/// What the tets of one label are.
struct TissueRegion {
  std::int32_t label = 0;
  std::string name;                            ///< as the segmentation has it, any characters
  std::array<double, 3> color{0.5, 0.5, 0.5};  ///< RGB in 0..1
  bool named = true;                           ///< false: no file says the name, and readMesh made it up
};

/// A mesh of one tissue or of several, as files hold it.
struct TissueMesh {
  TetMesh mesh;                       ///< LPS mm
  std::vector<TissueRegion> regions;  ///< one per label of the mesh
  MeshArrays arrays;
  std::vector<CurvedEdge> curvedEdges = {};  ///< for tets of ten nodes; ascending by nodes, see curveBoundary
};

}  // namespace sinew
