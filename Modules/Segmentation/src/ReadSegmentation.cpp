#include "sinew/Segmentation/ReadSegmentation.h"

#include "ImageHeader.h"
#include "ItkImage.h"
#include "SlicerKeys.h"
#include "Text.h"

#include <utility>

namespace sinew {

namespace {

/// Several components are layers of labels in Slicer's segmentations, and in other lists that are no time
/// series.
bool isLayered(const ImageHeader& header) {
  return slicer::isSegmentation(header.keys) || (header.list && !slicer::isVolumeSeries(header.keys));
}

/// What Slicer writes when there is nothing to write.
bool isPlaceholder(const ImageGeometry& geometry) { return geometry.voxelCount() == 1; }

void applyLabelTable(Segmentation& segmentation, const LabelTable& table) {
  for (auto* tissues : {&segmentation.tissues, &segmentation.emptyTissues})
    for (Tissue& tissue : *tissues) {
      const auto found = table.find(tissue.label);
      if (found == table.end()) continue;
      const auto& [name, color, terminology] = found->second;
      tissue.color = color;
      if (!terminology.empty()) tissue.tags["TerminologyEntry"] = terminology;
      if (name.empty()) continue;
      tissue.name = name;
      if (!tissue.named) tissue.id = name;
      tissue.named = true;
    }
}

}  // namespace

Segmentation readSegmentation(const std::filesystem::path& file, const ReadSegmentationOptions& options) {
  // The table first: a wrong one is found before the long work.
  const LabelTable table = options.lut ? readLabelTable(*options.lut) : LabelTable{};
  const ImageHeader header = readImageHeader(file);
  LabelImage image = readItkImage(file, header, isLayered(header));
  if (isPlaceholder(image.geometry))
    text::refuse(file,
                 "holds a single voxel, which is how 3D Slicer saves an empty segmentation; paint something, "
                 "or export the one that you meant");

  Segmentation segmentation;
  segmentation.geometry = image.geometry;
  segmentation.layers = std::move(image.layers);
  segmentation.source = file.string();
  if (slicer::isSegmentation(header.keys)) {
    segmentation.tissues =
        slicer::readSegments(file, header.keys, static_cast<int>(segmentation.layers.size()));
    segmentation.keys = slicer::otherKeys(header.keys);
  }
  updateTissueTable(segmentation);
  if (segmentation.tissues.empty())
    text::refuse(file,
                 "has no voxel other than 0, so there is no tissue in it; check that it is the segmentation");
  applyLabelTable(segmentation, table);
  return segmentation;
}

}  // namespace sinew
