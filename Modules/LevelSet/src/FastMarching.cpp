#include "sinew/LevelSet/FastMarching.h"

#include "SurfaceSeeds.h"
#include "TiledMarch.h"

#include <stdexcept>

namespace sinew {

void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band) {
  if (!(spacing.array() > 0).all() || !(band > 0))
    throw std::invalid_argument("fastMarching: spacing and band must be positive");
  tiledMarch(phi, surfaceSeeds(phi, spacing), spacing, band);
}

}  // namespace sinew
