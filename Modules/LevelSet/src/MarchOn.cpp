#include "MarchOn.h"

#include "TiledMarch.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace sinew {
namespace {

/// Slice by slice in raster order.
std::vector<std::vector<SurfaceSeed>> samplesNearer(const DenseField& phi, float near) {
  std::vector<std::vector<SurfaceSeed>> seeds(static_cast<std::size_t>(phi.size.z()));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      for (int i = 0; i < phi.size.x(); ++i)
        if (std::abs(row[i]) < near) seeds[static_cast<std::size_t>(k)].push_back({i, j, row[i]});
    }
  });
  return seeds;
}

}  // namespace

void marchOn(DenseField& phi, double spacing, double near, double band) {
  const auto known = static_cast<float>(near);
  DenseField far = phi;
  tiledMarch(far, samplesNearer(phi, known), Eigen::Vector3d::Constant(spacing), band,
             {.keepWithin = std::numeric_limits<double>::infinity()});
  for (std::size_t n = 0; n < far.values.size(); ++n)
    if (!(std::abs(phi.values[n]) < known)) phi.values[n] = far.values[n];
}

}  // namespace sinew
