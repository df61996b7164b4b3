#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// A sample near the surface and its signed distance, mm.
struct SurfaceSeed {
  int i, j;
  float distance;  ///< never zero inside
};

/// The samples that have a neighbour (of six) on the other side, slice by slice in raster order, with the
/// distance to the closest point of the tricubic interpolant's zero set. Cost: O(samples), slices in
/// parallel.  Source: Chopp 2001.
/// @param layers  more than 1: also the samples that are so many steps along the axes from the other side,
///                where a closest point is found
std::vector<std::vector<SurfaceSeed>> surfaceSeeds(const DenseField& phi, const Eigen::Vector3d& spacing,
                                                   int layers = 1);

}  // namespace sinew
