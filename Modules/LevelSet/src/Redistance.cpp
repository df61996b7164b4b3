#include "sinew/LevelSet/Redistance.h"

#include "sinew/LevelSet/FastMarching.h"

namespace sinew {

void redistance(DenseLevelSet& levelSet) {
  fastMarching(levelSet.phi, Eigen::Vector3d::Constant(levelSet.voxelSize), levelSet.band,
               {.closestPointLayers = 2});
}

}  // namespace sinew
