#include "sinew/Elasticity/Material.h"

#include <stdexcept>

namespace sinew {

Lame lame(double young, double poisson) {
  if (!(young > 0)) throw std::invalid_argument("lame: Young's modulus must be positive");
  if (!(poisson > -1 && poisson < 0.5))
    throw std::invalid_argument("lame: Poisson's ratio must be in (-1, 0.5)");
  return {.mu = young / (2 * (1 + poisson)), .lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

}  // namespace sinew
