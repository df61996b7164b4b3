#include "StepsFromSurface.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace sinew {
namespace {

/// Two neighbouring rows: beside each other on different sides, or one step farther than the other.
void relax(const float* phi, const float* other, const std::uint8_t* otherSteps, std::uint8_t* steps, int n) {
  for (int i = 0; i < n; ++i) {
    const bool across = (phi[i] < 0) != (other[i] < 0);
    const auto step = static_cast<std::uint8_t>(across ? 1 : otherSteps[i] + 1);
    steps[i] = std::min(steps[i], step);
  }
}

}  // namespace

DenseMask stepsFromSurface(const DenseField& phi, int atMost) {
  DenseMask steps(phi.size, static_cast<std::uint8_t>(atMost + 1));
  const int nx = phi.size.x(), ny = phi.size.y(), nz = phi.size.z();
  const auto pass = [&](int j, int k, int fromJ, int fromK) {
    relax(phi.row(j, k), phi.row(fromJ, fromK), steps.row(fromJ, fromK), steps.row(j, k), nx);
  };
  tbb::parallel_for(0, nz, [&](int k) {
    for (int j = 0; j < ny; ++j) {
      const float* row = phi.row(j, k);
      std::uint8_t* s = steps.row(j, k);
      for (int i = 1; i < nx; ++i) relax(row + i, row + i - 1, s + i - 1, s + i, 1);
      for (int i = nx - 2; i >= 0; --i) relax(row + i, row + i + 1, s + i + 1, s + i, 1);
    }
    for (int j = 1; j < ny; ++j) pass(j, k, j - 1, k);
    for (int j = ny - 2; j >= 0; --j) pass(j, k, j + 1, k);
  });
  tbb::parallel_for(0, ny, [&](int j) {
    for (int k = 1; k < nz; ++k) pass(j, k, j, k - 1);
    for (int k = nz - 2; k >= 0; --k) pass(j, k, j, k + 1);
  });
  return steps;
}

}  // namespace sinew
