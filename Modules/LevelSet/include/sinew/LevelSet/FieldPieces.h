#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <cstdint>
#include <vector>

namespace sinew {

/// Which samples hang together.
enum class Connectivity { Faces, Corners };  ///< 6 or 26 neighbours

/// The connected pieces of the samples on one side of a field.
struct FieldPieces {
  DenseRaster<std::int32_t> ids;       ///< -1 on the other side, else index into `samples`
  std::vector<std::int64_t> samples;   ///< how many each piece has; pieces in raster order of their first
  std::vector<std::uint8_t> atBorder;  ///< whether a piece reaches the border of the raster
};

/// Pieces of phi < 0 (`inside`) or of phi >= 0. Cost: O(samples).
FieldPieces fieldPieces(const DenseField& phi, bool inside, Connectivity connectivity);

}  // namespace sinew
