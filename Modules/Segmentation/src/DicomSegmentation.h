#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <optional>

namespace sinew {

/// Whether a file is DICOM by its content.
bool isDicom(const std::filesystem::path& file);

/// Reads a DICOM segmentation. Labels are the segments' numbers, overlapping segments come to different
/// layers, slices without a frame are background. Names, colours and codes are those of the file.
/// @param fractionalThreshold  least share of a fractional voxel that belongs, in (0, 1]; without it they are
/// refused
/// @throws std::runtime_error, one line naming the file: what is wrong and what to do
/// Cost: O(pixels * layers); memory: the frames, and 4 bytes per voxel and layer.
Segmentation readDicomSegmentation(const std::filesystem::path& file,
                                   std::optional<double> fractionalThreshold);

}  // namespace sinew
