#include "SampledLevelSet.h"

#include "sinew/LevelSet/LevelSetGrid.h"

#include <cmath>
#include <memory>

namespace sinew::test {

LevelSet sampled(const std::function<double(const Eigen::Vector3d&)>& phi, const Eigen::Vector3i& lower,
                 const Eigen::Vector3i& upper, double voxelSize) {
  LevelSet levelSet;
  levelSet.voxelSize = voxelSize;
  levelSet.band = 3 * voxelSize;
  levelSet.lower = lower;
  levelSet.upper = upper;
  const auto band = static_cast<float>(levelSet.band);
  auto grid = openvdb::FloatGrid::create(band);
  auto accessor = grid->getAccessor();
  for (int x = lower.x(); x <= upper.x(); ++x)
    for (int y = lower.y(); y <= upper.y(); ++y)
      for (int z = lower.z(); z <= upper.z(); ++z) {
        const auto value = static_cast<float>(voxelSize * phi({double(x), double(y), double(z)}));
        if (std::abs(value) < band)
          accessor.setValue({x, y, z}, value);
        else
          accessor.setValueOff({x, y, z}, value < 0 ? -band : band);
      }
  grid->pruneGrid();
  levelSet.grid = std::make_shared<LevelSetGrid>(LevelSetGrid{grid});
  return levelSet;
}

}  // namespace sinew::test
