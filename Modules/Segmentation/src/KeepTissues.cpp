#include "sinew/Segmentation/KeepTissues.h"

#include <set>
#include <utility>

namespace sinew {

void keepTissues(Segmentation& segmentation, const std::vector<int>& tissues) {
  std::vector<Tissue> kept;
  std::vector<std::set<std::int32_t>> labels(segmentation.layers.size());
  for (const int tissue : tissues) {
    kept.push_back(std::move(segmentation.tissues[tissue]));
    labels[kept.back().layer].insert(kept.back().label);
  }
  segmentation.tissues = std::move(kept);
  segmentation.emptyTissues.clear();
  for (std::size_t n = 0; n < labels.size(); ++n)
    for (std::int32_t& voxel : segmentation.layers[n])
      if (voxel != 0 && !labels[n].contains(voxel)) voxel = 0;
}

}  // namespace sinew
