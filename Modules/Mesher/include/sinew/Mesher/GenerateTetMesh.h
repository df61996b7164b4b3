#pragma once

#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/SignedDistance.h"
#include "sinew/Mesher/TetBounds.h"
#include "sinew/Mesher/TetMesh.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Moves a candidate mesh onto phi = 0; no tet may be inverted afterwards.
using Compressor =
    std::function<CompressionReport(TetMesh& mesh, const SignedDistance& phi, const CompressionOptions&)>;

struct GenerateTetMeshOptions {
  double edgeLength = 0;     ///< cube size of the lattice at the surface, mm, > 0
  double maxEdgeLength = 0;  ///< largest cube size deep inside, mm; 0: eight times edgeLength
  /// Smallest cube size that thickness, and down to phi.resolution() also curvature and tolerance, may ask
  /// for, mm; 0: phi.resolution(). What is above edgeLength counts as edgeLength.
  double minEdgeLength = 0;
  double curvature =
      1.0;               ///< refine where cube size * (|k1| + |k2|) exceeds this; 0: nowhere, nor thin parts
  double tolerance = 0;  ///< refine where an edge would leave the surface by more, mm; 0 switches it off
  int levels = 0;        ///< largest number of lattice levels; 0: as many as the sizes ask for
  std::int32_t label = 1;  ///< written to TetMesh::labels
  Compressor compressor{};         ///< of the whole candidate; empty: compressOntoSurface
  RepairBounds repair{};           ///< where the candidate gives way afterwards
  std::function<void(std::string_view stage, double fraction)>
      progress;  ///< called from one thread; may throw to stop
};

/// What happened on the way.
struct GenerateTetMeshReport {
  struct Stage {
    std::string name;
    double seconds = 0;
  };
  std::vector<Stage> stages;       ///< lattice, candidate, compression, in this order
  int repairPasses = 0;            ///< passes of the T1-T3 repair
  std::int64_t nodesReleased = 0;  ///< lattice nodes that it gave up where enveloping came to no end
  std::int64_t patchesTried = 0;   ///< places with bad tets where the candidate gave way
  std::int64_t patchesMended = 0;  ///< those that are better for it
  double maxBoundaryPhi = 0;       ///< largest |phi| at a boundary node, mm
  double finestCube = 0;           ///< cube size of the finest lattice level used, mm
  std::int64_t latticeNodes = 0;   ///< nodes of the red-green lattice
};

/// Meshes phi < 0: lattice, red-green hierarchy, candidate, compression (Teran et al. 2005).
/// The result is the same bits for any number of threads. A shape too small for the lattice gives a mesh
/// without tets.
/// @throws std::invalid_argument on options out of range; std::runtime_error when boundary nodes cannot reach
/// the surface.
TetMesh generateTetMesh(const SignedDistance& phi, const GenerateTetMeshOptions& options,
                        GenerateTetMeshReport* report = nullptr);

/// Memory that generateTetMesh takes for every tet of its result, bits of the lattice included; measured at
/// the peak of the compression.
inline constexpr double kBytesPerTet = 400;

/// A rough upper estimate of the memory that generateTetMesh takes, bytes. Cost: O(bounds / maxEdgeLength^3).
double estimateMemory(const SignedDistance& phi, const GenerateTetMeshOptions& options);

}  // namespace sinew
