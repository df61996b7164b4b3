#pragma once

#include "FileFailure.h"
#include "Regions.h"
#include "sinew/Mesher/TetMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sinew {

/// The label of one cell: whole, and in the range of the original values. @throws std::runtime_error naming
/// the file
inline std::int32_t checkedLabel(double value, std::int64_t cell, const std::filesystem::path& file) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(value == std::floor(value) && value >= Limits::min() && value <= Limits::max()))
    fail(file, "cell " + std::to_string(cell) + " has the label " + std::to_string(value) +
                   ", which is not a 32-bit whole number");
  return static_cast<std::int32_t>(value);
}

/// The tet of a cell that has `size` points. @throws std::runtime_error naming the file when it is none, or
/// names a node that is not there
template <class Index>
Tet checkedTet(const Index* points, std::int64_t size, std::int64_t cell, std::size_t nodeCount,
               const std::filesystem::path& file) {
  if (size != 4) fail(file, "cell " + std::to_string(cell) + " is a tet without four nodes");
  Tet tet{};
  for (int k = 0; k < 4; ++k) {
    if (points[k] < 0 || points[k] >= static_cast<Index>(nodeCount))
      fail(file, "cell " + std::to_string(cell) + " names a node that is not there");
    tet[k] = static_cast<std::int32_t>(points[k]);
  }
  return tet;
}

/// A cell of each label, noted while they are read.
class FirstCells {
 public:
  void note(std::int32_t label, std::int64_t cell) {
    if (cells_.empty() || label != last_) cells_.try_emplace(label, cell);
    last_ = label;
  }
  /// The regions, ascending.
  /// @param named    those that the file names
  /// @param colorOf  cell -> std::optional of its colour
  template <class ColorOf>
  std::vector<TissueRegion> regions(const std::vector<TissueRegion>& named, const ColorOf& colorOf) const {
    std::vector<TissueRegion> regions;
    for (const auto& [label, cell] : cells_) {
      const auto found = std::ranges::find(named, label, &TissueRegion::label);
      regions.push_back(found != named.end() ? *found : unnamedRegion(label));
      if (const auto color = colorOf(cell)) regions.back().color = *color;
    }
    return regions;
  }

 private:
  std::map<std::int32_t, std::int64_t> cells_;
  std::int32_t last_ = 0;
};

}  // namespace sinew
