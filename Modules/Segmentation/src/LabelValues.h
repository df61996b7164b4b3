#pragma once

#include "sinew/Segmentation/ImageGeometry.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace sinew {

/// The numbers that a voxel may be stored as.
enum class ValueType { UInt8, Int8, UInt16, Int16, UInt32, Int32, UInt64, Int64, Float32, Float64 };

std::size_t bytesOf(ValueType type);

/// Converts stored values to labels: whole numbers of 32 bits.
/// @param values  the value of voxel `first`; the next voxel's is `stride` values behind
/// @throws std::runtime_error naming the file, and the first value that is no label with its voxel
/// Cost: O(labels)
void convertToLabels(const std::filesystem::path& file, const ImageGeometry& geometry, ValueType type,
                     const std::byte* values, std::size_t stride, std::size_t first,
                     std::span<std::int32_t> labels);

}  // namespace sinew
