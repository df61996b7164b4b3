#pragma once

#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sinew {

struct MeshTissuesOptions {
  double edgeLength = 0;                     ///< cube size at the surface, mm; 0: 2vox
  double maxEdgeLength = 0;                  ///< cube size deep inside, mm; 0: eight times the edge length
  std::map<std::string, double> sizes;       ///< tissue name -> edge length, mm
  double curvature = 0.7;                    ///< see GenerateTetMeshOptions
  int levels = 0;                            ///< see GenerateTetMeshOptions
  LevelSetFromLabelsOptions levelSet;        ///< labels to distance
};

enum class TissueStatus { Meshed, Lost, Failed };

struct Fidelity {
  double maxBoundaryPhi = 0;     ///< largest |phi| at a boundary node, mm
  double surfaceRms = 0;         ///< distance of boundary nodes, edge midpoints and centroids from phi = 0, mm
  double surfaceMax = 0;         ///< mm
  double volume = 0;             ///< of the mesh, mm^3
  double labelVolume = 0;        ///< mm^3
  double levelSetVolume = 0;     ///< mm^3
  double dice = 0;               ///< of label voxels and voxels with their centre in the mesh
};

/// What the labels had and the mesh has not.
struct LostPieces {
  std::int64_t components = 0;
  double volume = 0;             ///< mm^3
};

struct TissueReport {
  std::string name;
  std::int32_t label = 0;
  int layer = 0;
  std::string file;              ///< name inside the output folder; empty when nothing was written
  TissueStatus status = TissueStatus::Failed;
  std::string message;           ///< one line: why it was lost or failed, or a warning
  std::vector<std::pair<std::string, double>> seconds;  ///< stage -> wall seconds, in order
  MeshQuality quality;
  MeshConditions conditions;
  MeshTopology topology;
  std::int64_t levelSetComponents = 0;
  std::int64_t levelSetEuler = 0;
  Fidelity fidelity;
  LostPieces lost;
};

/// Called from any thread as tissues advance: name, stage, and the fraction of all work done so far, in [0, 1].
using TissueProgress = std::function<void(const std::string& tissue, const std::string& stage, double done)>;

/// Meshes the tissues with the given indices into `segmentation.tissues`, one file `<name>.vtu` each in `folder`
/// (which exists). Tissues run in parallel, the largest first; the memory in flight is bounded by the largest ones.
/// A tissue that cannot be meshed is reported, the others are written. The files do not depend on the number of
/// threads. Throws only what stops everything (a cancelled run, an unwritable folder).
std::vector<TissueReport> meshTissues(const Segmentation& segmentation, const std::vector<int>& tissues,
                                      const std::filesystem::path& folder, const MeshTissuesOptions& options = {},
                                      const TissueProgress& progress = {});

}  // namespace sinew
