#pragma once

#include "sinew/Elasticity/CompressionMethod.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/ShapeMeasures.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Pipeline/Length.h"
#include "sinew/Pipeline/Smoothing.h"
#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

struct MeshTissuesOptions {
  /// Cube size at the surface, > 0. At most the tissue's extent; up to two voxels at most a third of the cube
  /// root of its volume.
  Length edgeLength = Length::voxels(2);
  Length maxEdgeLength = 0;  ///< cube size deep inside; 0: eight times the edge length
  /// Smallest cube that refinement may make; 0: the level set's spacing, and where more than 1 % of the
  /// volume would be lost half a voxel, or a quarter of the edge length where that is more.
  Length minEdgeLength = 0;
  std::map<std::string, Length> sizes;  ///< tissue, by a wish as in selectTissues -> its own edge length, > 0
  /// Choose the edge length of tissues without one in `sizes` for so many tets within 10 %; 0: off.
  /// Refinement then goes two levels down at most.
  std::int64_t targetTets = 0;
  double curvature = 1.0;                                      ///< see GenerateTetMeshOptions
  Length tolerance = 0;                                        ///< see GenerateTetMeshOptions; 0: off
  int levels = 0;                                              ///< see GenerateTetMeshOptions
  CompressionMethod method = CompressionMethod::Optimization;  ///< how the mesh is fitted to the surface
  PhysicsCompressionOptions physics;                           ///< of the methods with physics
  /// Keep the level set's volume within 0.1 % instead of 0.5 %, by moving the boundary by a tenth of an edge
  /// length at most instead of a twentieth, and in up to three new meshings where that does not do.
  bool preserveVolume = false;
  bool withQuality = false;  ///< write arrays of quality and level set to the files
  Smoothing smoothing;
  std::map<std::string, Smoothing> smoothings;  ///< tissue, by a wish as in selectTissues -> its own
  LevelSetFromLabelsOptions levelSet;           ///< labels to distance
  std::string extension = ".vtu";               ///< of the files: one of meshFormats()
  WriteMeshOptions writing;                     ///< space, unit and tags of the files
};

enum class TissueStatus { Meshed, Lost, Failed };

struct Fidelity {
  double surfaceOffset = 0;   ///< the boundary was moved from phi = 0 to this, mm, to keep the volume; nodes
                              ///< that bad tets hold back stay between
  double maxBoundaryPhi = 0;  ///< largest distance of a boundary node from between the two, mm
  double surfaceRms = 0;      ///< the same of boundary nodes, edge midpoints and centroids, mm
  double surfaceMax = 0;      ///< mm
  Eigen::Vector3d surfaceMaxPlace = Eigen::Vector3d::Zero();  ///< where it is that far, LPS mm
  double volume = 0;                                          ///< of the mesh, mm^3
  double labelVolume = 0;                                     ///< mm^3
  double levelSetVolume = 0;                                  ///< mm^3
  double dice = 0;  ///< of label voxels and voxels with their centre in the mesh
};

/// Pieces (26-connected) and cavities (6-connected) of a tissue before and after smoothing.
struct SmoothingReport {
  ShapeTopology voxels;     ///< as the labels have them
  ShapeTopology levelSet;   ///< as the level set's samples have them
  double volumeChange = 0;  ///< that motion by mean curvature left, as part of the volume
};

/// What the labels had and the mesh has not: 26-connected pieces of which no voxel has its centre in the
/// mesh.
struct LostPieces {
  std::int64_t components = 0;
  double volume = 0;  ///< mm^3
};

/// What a mesh did to the level set's shape at a place where the two differ in topology.
enum class TopologyChange {
  PieceLost,     ///< a piece of the shape has nothing in the mesh
  BridgeLost,    ///< parts that the shape joins are apart in the mesh
  SheetPierced,  ///< the mesh has a hole through a sheet that is whole
  VoidOpened,    ///< the mesh has a void inside of the shape
  VoidClosed,    ///< the mesh fills a void
  HoleClosed,    ///< the mesh fills a hole through the shape
  GapClosed,     ///< the mesh joins parts that the shape keeps apart
  PieceAdded,    ///< a piece of the mesh has nothing in the shape
};

/// A place where the topology of a mesh differs from its level set's: where the change is narrowest.
struct TopologyDifference {
  TopologyChange change = TopologyChange::PieceLost;
  Eigen::Vector3d place;   ///< LPS mm
  double width = 0;        ///< of what the mesh has lost or closed, twice its largest |phi|, mm
  std::int64_t euler = 0;  ///< what mending it would add to the Euler characteristic of the mesh's boundary
  double volume = 0;       ///< of what was lost or closed; of bridges, sheets, holes, gaps a slice, mm^3
  std::string reason;      ///< why the mesh is not like the level set there
};
inline constexpr std::size_t kListedTopologyDifferences = 20;

/// One of the worst tets of a mesh by one measure.
struct WorstElement {
  std::string measure;       ///< `aspect_ratio`, `min_dihedral_deg` or `max_dihedral_deg`
  std::int64_t element = 0;  ///< number of the tet in the file, from 0
  double value = 0;
  Eigen::Vector3d place;  ///< its centroid, LPS mm
};

/// How the mesh was fitted to the surface.
struct TissueCompression {
  CompressionMethodReport method;  ///< of the methods with physics
  std::int64_t patchesTried = 0;   ///< see GenerateTetMeshReport
  std::int64_t patchesMended = 0;  ///< see GenerateTetMeshReport
};

struct TissueReport {
  std::string name;
  std::string id;
  std::int32_t label = 0;
  int layer = 0;
  std::array<double, 3> color{};  ///< RGB in 0..1
  std::optional<std::int32_t>
      combinedLabel;  ///< in the combined mesh; another one where tissues share `label`
  std::string file;   ///< name inside the output folder; empty when nothing was written
  TissueStatus status = TissueStatus::Failed;
  std::string message;                                  ///< one line: why it was lost or failed, or a warning
  double edgeLength = 0;                                ///< as taken for this tissue, mm
  double minEdgeLength = 0;                             ///< that refinement might make, mm
  std::vector<std::pair<std::string, double>> seconds;  ///< stage -> wall seconds, in order
  TissueCompression compression;
  MeshQuality quality;
  std::vector<WorstElement> worst;  ///< up to kRankedTets of each measure, the worst first
  MeshConditions conditions;
  MeshTopology topology;
  SmoothingReport smoothing;
  std::int64_t levelSetComponents = 0;
  std::int64_t levelSetEuler = 0;
  std::int64_t topologyDifferenceCount = 0;
  std::vector<TopologyDifference> topologyDifferences;  ///< up to kListedTopologyDifferences, widest first
  Fidelity fidelity;
  LostPieces lost;
  std::optional<CurvedBoundary> curved;  ///< of tets of ten nodes, without the edges themselves
};

/// Called from any thread, one call at a time, as tissues advance: name, stage, and the fraction of all work
/// done so far, in [0, 1]. May throw to stop the run: the other tissues then stop at their next call, partial
/// files are removed, and meshTissues throws the same exception.
using TissueProgress = std::function<void(const std::string& tissue, const std::string& stage, double done)>;

/// Meshes the tissues with the given indices into `segmentation.tissues`, one file each in `folder` (which
/// exists; empty: no files), named by tissueFileStems; a file appears when it is complete, and an older
/// one of that name goes when its tissue gives none. Tissues run in parallel, the largest first, as many at a
/// time as threads and memory allow. A tissue that cannot be meshed, or whose mesh is unsound, is reported
/// and not written; the others are. The files do not depend on the number of threads.
/// @param combined  if not null, receives all meshes as one, see combineMeshes; they stay in memory until
/// then
/// @return one report per entry of `tissues`, in that order
/// @throws std::invalid_argument before any computing on options out of range, a size for an unknown tissue,
/// or edge
///         lengths that take more memory than there is, naming the tissue and the need; otherwise only what
///         `progress` throws.
std::vector<TissueReport> meshTissues(const Segmentation& segmentation, const std::vector<int>& tissues,
                                      const std::filesystem::path& folder,
                                      const MeshTissuesOptions& options = {},
                                      const TissueProgress& progress = {}, TissueMesh* combined = nullptr);

}  // namespace sinew
