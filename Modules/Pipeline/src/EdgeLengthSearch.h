#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace sinew {

/// A mesh that was made on the way to a number of tets.
struct SizeTrial {
  double edge = 0;  ///< mm
  std::int64_t tets = 0;
};

inline constexpr int kMostSizeTrials = 6;

/// Whether a mesh has the wanted number of tets within 10 %.
bool hasTets(std::int64_t tets, std::int64_t wanted);

/// The trial whose number of tets is nearest to the wanted one, by its logarithm; the first of equals.
std::size_t bestTrial(const std::vector<SizeTrial>& trials, std::int64_t wanted);

/// Edge length to begin with, mm: surface tets grow as area / edge^2, and there are not more than
/// volume / edge^3 allows.
/// @param area, volume  of the tissue, mm^2 and mm^3
double firstEdgeLength(double area, double volume, std::int64_t wanted);

/// Edge length to try next: regula falsi in log(tets) over log(edge), halving where it sticks; beyond the
/// trials along their secant.
/// @param trials  at least one
/// @return nothing when the best trial is good, the trials are used up, or the number jumps over the wanted
/// one
std::optional<double> nextEdgeLength(const std::vector<SizeTrial>& trials, std::int64_t wanted);

}  // namespace sinew
