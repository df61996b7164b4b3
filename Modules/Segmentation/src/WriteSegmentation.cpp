#include "sinew/Segmentation/WriteSegmentation.h"

#include "ImageHeader.h"
#include "SlicerKeys.h"
#include "Text.h"
#include "VoxelFile.h"

namespace sinew {

void writeSegmentation(const Segmentation& segmentation, const std::filesystem::path& file) {
  const auto keys = slicer::writeKeys(segmentation);
  if (keys.size() > kMostNrrdKeys)
    text::refuse(file, "would have " + std::to_string(keys.size()) + " key/value pairs for its " +
                           std::to_string(segmentation.tissues.size() + segmentation.emptyTissues.size()) +
                           " segments, more than the " + std::to_string(kMostNrrdKeys) +
                           " that Sinew reads; write a plain label map");
  writeNrrd(segmentation, file, keys);
}

}  // namespace sinew
