#pragma once

#include "sinew/Segmentation/LabelTable.h"
#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <optional>

namespace sinew {

struct ReadSegmentationOptions {
  std::optional<std::filesystem::path> lut =
      {};  ///< colour table for names and colours; overrides the file's own

  /// DICOM SEG of fractional type: voxels of at least this share, in (0, 1], belong to the tissue. Without it
  /// such files are refused.
  std::optional<double> fractionalThreshold = {};
};

/// Reads a labelled volume: .nrrd, .nhdr, .seg.nrrd (one layer or several), .nii, .nii.gz, .mha, .mhd, of any
/// integer pixel type, or floating point when every value is whole; and DICOM segmentations (binary,
/// overlapping ones to several layers, fractional, label maps). Geometry is ITK's (LPS mm). Formats and
/// Slicer segmentations are recognised by the content, not by the name. The sform of a NIfTI file that
/// ITK 5.2 refuses (no qform, and sheared or off by rounding) is taken as it stands. A Slicer layer ends
/// where the Extents of its segments end, as in 3D Slicer, with a warning.
/// @throws std::runtime_error: one line that names the file, what is wrong and what to do;
///         std::invalid_argument for a threshold outside (0, 1]
Segmentation readSegmentation(const std::filesystem::path& file, const ReadSegmentationOptions& options = {});

/// Whether the content begins like a file that readSegmentation takes, whatever its name.
/// @throws std::runtime_error naming the file when it is missing, empty or unreadable
bool isImageFile(const std::filesystem::path& file);

}  // namespace sinew
