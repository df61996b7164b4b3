#pragma once

#include "sinew/Segmentation/LabelTable.h"
#include "sinew/Segmentation/MergeLayers.h"
#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace sinew {

/// Whether writeLabelMap knows the ending: .nrrd, .nii, .nii.gz, .mha, .mhd. A `.seg.nrrd` is a segmentation,
/// no plain label map: writeSegmentation makes it.
bool isLabelMapName(const std::filesystem::path& file);

struct LabelMapReport {
  LabelTable table;                  ///< names and colours of the labels as they are in the file
  std::vector<LabelChange> changes;  ///< labels that several layers used, and their new values
  std::int64_t contestedVoxels = 0;  ///< that several tissues claimed, and one of them kept
};

/// Writes a plain label map, one whole number per voxel, of the smallest integer type that holds the labels:
/// gzipped NRRD, NIfTI-1 (qform and sform alike), MetaImage (packed; a .mhd is one file, too, with its voxels
/// behind the header). Geometry is that of the segmentation; NIfTI holds it in single precision, and axes
/// that are not at right angles only in its sform. Names do not fit in: write report.table beside it. Its
/// bytes depend on nothing but the segmentation.
/// @param options  what becomes of overlapping tissues, see mergeLayers
/// @throws std::invalid_argument for an ending that is not among isLabelMapName's; std::runtime_error naming
/// the file
///         when it cannot be written or the format cannot hold it, or naming two tissues that overlap
LabelMapReport writeLabelMap(const Segmentation& segmentation, const std::filesystem::path& file,
                             const MergeLayersOptions& options = {});

}  // namespace sinew
