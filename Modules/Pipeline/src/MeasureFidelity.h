#pragma once

#include "LevelSetSurface.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// How well a mesh keeps its tissue, and which 26-connected pieces of the tissue it has lost: those of which
/// no voxel has its centre in the mesh.
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
/// @param surface   the level set that the mesh was made from, in its own frame
/// @param frame     that frame, as in LevelSet
/// @param volumes   of label and level set
/// Cost: O(tets + voxels of the tissue's box).
FidelityReport measureFidelity(const TetMesh& mesh, const std::vector<Triangle>& boundary,
                               const SignedDistance& surface, const Eigen::Isometry3d& frame,
                               const LevelSetFromLabelsReport& volumes, const Segmentation& segmentation,
                               const Tissue& tissue);

}  // namespace sinew
