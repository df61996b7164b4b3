#include "SampledLevelSet.h"

#include <algorithm>

namespace sinew::test {

DenseLevelSet sampled(const std::function<double(const Eigen::Vector3d&)>& phi, const Eigen::Vector3i& lower,
                      const Eigen::Vector3i& upper, double voxelSize) {
  DenseLevelSet levelSet;
  levelSet.voxelSize = voxelSize;
  levelSet.band = 3 * voxelSize;
  levelSet.frame.translation() = voxelSize * lower.cast<double>();
  levelSet.phi = DenseField(upper - lower + Eigen::Vector3i::Ones());
  const auto band = static_cast<float>(levelSet.band);
  for (int z = lower.z(); z <= upper.z(); ++z)
    for (int y = lower.y(); y <= upper.y(); ++y)
      for (int x = lower.x(); x <= upper.x(); ++x) {
        const auto value = static_cast<float>(voxelSize * phi(Eigen::Vector3d(x, y, z)));
        levelSet.phi(x - lower.x(), y - lower.y(), z - lower.z()) = std::clamp(value, -band, band);
      }
  return levelSet;
}

}  // namespace sinew::test
