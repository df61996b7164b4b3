#pragma once

#include "sinew/LevelSet/LevelSet.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew {

/// A surface of triangles in LPS mm.
struct TriangleSurface {
  const std::vector<Eigen::Vector3d>& nodes;
  const std::vector<std::array<std::int32_t, 3>>& triangles;
};

struct LevelSetFromTrianglesOptions {
  double spacing = 0;     ///< mm; 0: a 200th of the longest side of the surface's box
  double bandVoxels = 4;  ///< half width of the narrow band, level set voxels, in [3, 100]
};

/// What the surface was made of.
struct LevelSetFromTrianglesReport {
  std::int64_t solids = 0;    ///< connected surfaces that hold the shape
  std::int64_t cavities = 0;  ///< those turned the other way, which bound holes inside of it
  double surfaceVolume = 0;   ///< volume that the triangles enclose, mm^3
  double levelSetVolume = 0;  ///< volume of phi < 0, mm^3
};

/// Turns closed surfaces of triangles into the signed distance of what they enclose, on a grid along the axes
/// of LPS: OpenVDB's mesh to volume for every connected surface, then union or difference, the largest first.
/// All triangles may be turned inwards or outwards; a surface turned against the rest is a cavity, which may
/// hold solids again. Details below the
/// spacing are lost; edges stay as sharp as the grid can hold them. Distances are exact up to a voxel from
/// the surface, and within half a voxel in the rest of the band.
/// @throws std::invalid_argument on options out of range, and when the triangles are no closed manifold:
/// none at all, nodes that are not there or not finite, edges with one triangle or with more than two,
/// neighbours turned against each other, no volume.
/// Cost: O(triangles log triangles) plus O(triangles' area / spacing^2); the same grid for any number of
/// threads.
LevelSet levelSetFromTriangles(const TriangleSurface& surface,
                               const LevelSetFromTrianglesOptions& options = {},
                               LevelSetFromTrianglesReport* report = nullptr);

/// The same on the samples of a lattice; from a voxel and a half on the distances are marched.
/// @param band  mm, at most 100 times the spacing
/// @throws std::invalid_argument as above, and when the shape's box has more than 2^31 samples.
DenseLevelSet levelSetFromTriangles(const TriangleSurface& surface, const SampleLattice& lattice, double band,
                                    LevelSetFromTrianglesReport* report = nullptr);

}  // namespace sinew
