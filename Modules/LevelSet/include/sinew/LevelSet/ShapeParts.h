#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

#include <limits>
#include <vector>

namespace sinew {

/// The pieces (26-connected) of a shape, largest first, each trimmed to its own box.
std::vector<DenseLevelSet> shapeComponents(const DenseLevelSet& levelSet);

/// The `count` largest pieces. @throws std::invalid_argument unless count >= 1.
DenseLevelSet keepLargest(const DenseLevelSet& levelSet, int count = 1);

/// Without the pieces below a volume. @param least  mm^3, >= 0
DenseLevelSet dropSmall(const DenseLevelSet& levelSet, double least);

/// Without its cavities (6-connected hollows that nothing leads into) up to a volume, mm^3.
DenseLevelSet fillCavities(const DenseLevelSet& levelSet,
                           double most = std::numeric_limits<double>::infinity());

/// Without its cavities and its tunnels that no ball of this diameter fits through: what a closing by half of
/// it adds, as far as that shuts a hollow or a hole with two or more mouths. Dents, grooves and blind holes
/// stay.
/// @param width  mm, > 0
DenseLevelSet fillHoles(const DenseLevelSet& levelSet, double width);

}  // namespace sinew
