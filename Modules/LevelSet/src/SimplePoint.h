#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <cstdint>

namespace sinew {

/// The 27 samples around and including one, a bit each, set inside: bit  (i+1) + 3 (j+1) + 9 (k+1).
using Neighbourhood = std::uint32_t;

/// Reads it from a field; beyond the raster lies the outside.
Neighbourhood neighbourhoodOf(const DenseField& phi, const Eigen::Vector3i& at);

/// Whether the middle sample may change side without changing the topology of the inside (26-connected) or of
/// the outside (6-connected): the inside samples among its 26 neighbours are one 26-connected piece, and the
/// outside ones among its 18 nearest have one 6-connected piece that touches it by a face.
/// Source: Malandain, Bertrand 1992.
bool isSimplePoint(Neighbourhood neighbourhood);

/// The samples with phi < 0.
DenseMask insideOf(const DenseField& phi);

/// Gives `wanted` the topology of a mask: starting from the mask, samples take the side that `wanted` has for
/// them only while they are simple points, those farthest from the new surface (which lie beside the old one)
/// first. What must not change keeps its side, as near to the surface as `hold` (mm).
/// @return how many samples were held; 0: `wanted` is as it was.
/// Cost: O(samples), and more for each that changes side.
std::int64_t holdTopology(const DenseMask& inside, DenseField& wanted, float hold);

}  // namespace sinew
