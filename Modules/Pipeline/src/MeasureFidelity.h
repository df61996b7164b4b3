#pragma once

#include "LevelSetSurface.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// How well a mesh keeps its tissue, and which 26-connected pieces of the tissue it has lost: those of which
/// no voxel has its centre in the mesh.
/// Where the boundary of a mesh should lie: on phi = 0, or between it and phi = offset where it was moved
/// there to keep the volume, but for nodes that bad tets held back.
struct TargetSurface {
  const SignedDistance& phi;
  double offset = 0;        ///< mm
  Eigen::Isometry3d frame;  ///< of phi, as in LevelSet
};

struct FidelityReport {
  Fidelity fidelity;
  LostPieces lost;
};

/// In mm^3. Cost: O(tets).
double meshVolume(const TetMesh& mesh);
/// In mm^2. Cost: O(tets).
double boundaryArea(const TetMesh& mesh);

/// @param mesh      in LPS mm
/// @param boundary  its boundary triangles
/// @param volumes   of label and level set
/// Cost: O(tets + voxels of the tissue's box).
FidelityReport measureFidelity(const TetMesh& mesh, const std::vector<Triangle>& boundary,
                               const TargetSurface& target, const LevelSetFromLabelsReport& volumes,
                               const Segmentation& segmentation, const Tissue& tissue);

}  // namespace sinew
