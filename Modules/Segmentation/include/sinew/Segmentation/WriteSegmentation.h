#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>

namespace sinew {

/// Writes a labelled volume as a Slicer segmentation NRRD (gzip): the smallest integer type that holds the
/// labels, LPS, every SegmentN_* key of every tissue; kinds `list domain domain domain` exactly when there is
/// more than one layer. Its bytes depend on nothing but the segmentation.
/// @throws std::runtime_error naming the file when it cannot be written; std::invalid_argument when there is
/// no
///         layer, or one does not fit the geometry.
void writeSegmentation(const Segmentation& segmentation, const std::filesystem::path& file);

}  // namespace sinew
