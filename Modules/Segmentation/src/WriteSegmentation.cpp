#include "sinew/Segmentation/WriteSegmentation.h"

#include "SlicerKeys.h"
#include "VoxelFile.h"

namespace sinew {

void writeSegmentation(const Segmentation& segmentation, const std::filesystem::path& file) {
  writeNrrd(segmentation, file, slicer::writeKeys(segmentation));
}

}  // namespace sinew
