#pragma once

#include "LabelValues.h"
#include "sinew/Segmentation/ImageGeometry.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sinew {

/// Where and how the voxels of an image file are stored, one value each.
struct ImagePayload {
  std::filesystem::path file;
  std::uint64_t offset = 0;  ///< stored bytes before them
  bool compressed = false;   ///< zlib or gzip from there on
  std::uint64_t skip = 0;    ///< unpacked bytes before them
  std::uint64_t bytes = 0;   ///< of the voxels, unpacked
  ValueType type = ValueType::UInt8;
  bool swapped = false;            ///< the other byte order
  float slope = 1, intercept = 0;  ///< label = slope * value + intercept
};

/// Refuses sizes that the stored bytes cannot hold even at deflate's best ratio, before anyone allocates
/// them.
/// @throws std::runtime_error naming `file`
void requirePlausibleSize(const std::filesystem::path& file, const ImagePayload& payload);

/// Reads the voxels as labels, in small chunks: nothing is stored twice.
/// @throws std::runtime_error naming `file`: truncated or damaged voxels, values that are no labels
/// Cost: O(voxels) and the unpacking.
std::vector<std::int32_t> readPayload(const std::filesystem::path& file, const ImageGeometry& geometry,
                                      const ImagePayload& payload);

}  // namespace sinew
