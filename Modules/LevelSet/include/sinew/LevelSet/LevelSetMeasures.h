#pragma once

#include "sinew/LevelSet/LevelSet.h"

#include <cstdint>

namespace sinew {

/// Volume of phi < 0, better than voxel accuracy (see fieldVolume), mm^3.
/// Cost: O(leaves), in parallel; the same bits for any number of threads.
double levelSetVolume(const LevelSet& levelSet);

/// The zero surface of a level set as a piecewise linear surface.
struct LevelSetTopology {
  std::int64_t components = 0;  ///< connected pieces of phi < 0
  std::int64_t eulerCharacteristic =
      0;  ///< V - E + F of the surface phi = 0: 2 for a ball, 0 for a solid torus
};

/// Counts on the body-centred cubic split of the grid: the grid's samples, the cell centres with the mean of
/// their eight corners, and the tetrahedra between them, phi linear in each. The surface is then always a
/// closed 2-manifold (zero counts as outside), and no diagonal of a cell is preferred. Cost: O(active
/// voxels), memory for nine slices of the box.
LevelSetTopology levelSetTopology(const LevelSet& levelSet);

}  // namespace sinew
