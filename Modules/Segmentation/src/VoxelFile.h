#pragma once

#include "LabelValues.h"
#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What the writers of voxel files share.
namespace sinew {

/// An integer type that labels are written in.
struct VoxelType {
  ValueType type;
  std::int32_t least;
  std::int32_t most;
};

/// The smallest of 8 bits unsigned, 16 signed, 16 unsigned and 32 signed: 3D Slicer reads no other integers
/// as labels.
const VoxelType& smallestVoxelType(const Segmentation& segmentation);

/// @throws std::invalid_argument when there is no layer, or one does not fit the geometry.
void requireWritable(const Segmentation& segmentation);

/// Hands on the voxels of all layers in little-endian chunks, layer fastest.
void forVoxelBytes(const Segmentation& segmentation, const VoxelType& type,
                   const std::function<void(std::span<const std::byte>)>& sink);

/// Creates a file and lets `write` fill it.
/// @throws std::runtime_error naming the file when it cannot be created or not be written completely
void writeFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// NRRD, gzipped, `list` kind when there are several layers. `keys`: key/value pairs in order, unescaped.
void writeNrrd(const Segmentation& segmentation, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& keys);

/// NIfTI-1 of the first layer; gzipped when the name ends in .gz.
void writeNifti(const Segmentation& segmentation, const std::filesystem::path& file);

/// MetaImage of the first layer, packed, in one file: also a .mhd, so that it can be renamed.
void writeMeta(const Segmentation& segmentation, const std::filesystem::path& file);

}  // namespace sinew
