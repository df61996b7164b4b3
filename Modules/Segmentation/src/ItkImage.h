#pragma once

#include "ImageHeader.h"
#include "sinew/Segmentation/ImageGeometry.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sinew {

/// The voxels of an image file as labels.
struct LabelImage {
  ImageGeometry geometry;
  std::vector<std::vector<std::int32_t>> layers;  ///< one per component, x fastest
};

/// Reads a volume through ITK, in the file's own pixel type, and converts it to labels.
/// @param layered  several components are layers of labels; else they are refused
/// @throws std::runtime_error, one line naming the file: not three-dimensional, colours, vectors or tensors,
///         fractional values (the first, with its voxel), values beyond 32 bits, unreadable voxels
/// Cost: O(voxels); memory: the file's voxels and the labels.
LabelImage readItkImage(const std::filesystem::path& file, const ImageHeader& header, bool layered);

}  // namespace sinew
