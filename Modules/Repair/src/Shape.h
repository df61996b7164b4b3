#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/Solid.h"
#include "sinew/Repair/RepairSegmentation.h"

#include <memory>
#include <optional>
#include <string>

namespace sinew::repair {

using LevelSetPtr = std::shared_ptr<const DenseLevelSet>;

/// A value of a script that occupies space: a tissue as it was read (its level set is made when it is
/// needed), a solid (a formula, moved exactly), or a level set. Never changed once made.
struct Shape {
  std::string name;            ///< of the tissue it came from; empty for solids
  int origin = -1;             ///< index of that tissue in the input while it has not been moved, or -1
  bool untouched = false;      ///< it is that tissue, as it was read
  double blend = 0;            ///< radius of the fillet where it enters + - *, mm
  std::optional<Solid> solid;  ///< set for solids
  LevelSetPtr levelSet;        ///< set for computed shapes
  bool distance = true;        ///< the level set is a signed distance
  Eigen::AlignedBox3d box;     ///< that holds it, LPS mm; may be infinite
  double volume = 0;           ///< a guess, mm^3
  mutable std::optional<ShapeSummary> summary;  ///< of the level set, once measured
};
using ShapePtr = std::shared_ptr<const Shape>;

inline bool isFinite(const Eigen::AlignedBox3d& box) {
  return box.min().allFinite() && box.max().allFinite();
}

}  // namespace sinew::repair
