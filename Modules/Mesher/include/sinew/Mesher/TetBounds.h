#pragma once

#include "sinew/Mesher/MeshQuality.h"

namespace sinew {

/// Bounds on the shape of tets.
struct TetBounds {
  double aspectRatio;     ///< at most
  double minDihedralDeg;  ///< at least
  double maxDihedralDeg;  ///< at most

  bool exceededBy(const TetQuality& quality) const {
    return quality.aspectRatio > aspectRatio || quality.minDihedralDeg < minDihedralDeg ||
           quality.maxDihedralDeg > maxDihedralDeg;
  }
};

/// When a tet is mended after the compression. An aspect ratio up to 3 with angles of 30 to 130 degrees is
/// always good enough.
struct RepairBounds {
  TetBounds bad{3.5, 25, 140};    ///< beyond these it is worth a trial
  TetBounds grave{4.2, 20, 142};  ///< beyond these it must go, even at the price of other bad tets
};

}  // namespace sinew
