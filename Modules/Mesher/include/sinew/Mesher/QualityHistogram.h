#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <array>

namespace sinew {

inline constexpr double kDihedralBinDeg = 10;
inline constexpr std::size_t kDihedralBins = 18;

/// Lower ends of the bins of aspect ratios, each up to the next; the last one is open.
inline constexpr std::array<double, 14> kAspectRatioBins{1,    1.25, 1.5, 1.75, 2, 2.25, 2.5,
                                                         2.75, 3,    3.5, 4,    5, 10,   100};

/// How the quality of a mesh is spread.
struct QualityHistogram {
  std::array<std::int64_t, kDihedralBins> dihedrals{};               ///< six of each tet; 180 in the last bin
  std::array<std::int64_t, kAspectRatioBins.size()> aspectRatios{};  ///< one of each tet
};
/// Cost: O(tets).
QualityHistogram qualityHistogram(const TetMesh& mesh);

}  // namespace sinew
