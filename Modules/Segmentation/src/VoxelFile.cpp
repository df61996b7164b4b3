#include "VoxelFile.h"

#include "Text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace sinew {

namespace {

static_assert(std::endian::native == std::endian::little, "the headers say so");

constexpr std::array kVoxelTypes{
    VoxelType{ValueType::UInt8, 0, 255}, VoxelType{ValueType::Int16, -32768, 32767},
    VoxelType{ValueType::UInt16, 0, 65535}, VoxelType{ValueType::Int32, INT32_MIN, INT32_MAX}};

}  // namespace

const VoxelType& smallestVoxelType(const Segmentation& segmentation) {
  std::int32_t least = 0, most = 0;
  for (const auto& layer : segmentation.layers) {
    if (layer.empty()) continue;
    const auto [low, high] = std::ranges::minmax(layer);
    least = std::min(least, low);
    most = std::max(most, high);
  }
  return *std::ranges::find_if(
      kVoxelTypes, [&](const VoxelType& type) { return type.least <= least && most <= type.most; });
}

void requireWritable(const Segmentation& segmentation) {
  if (segmentation.layers.empty())
    throw std::invalid_argument("a segmentation to be written has no layer; it needs one at least");
  for (const auto& layer : segmentation.layers)
    if (static_cast<std::int64_t>(layer.size()) != segmentation.geometry.voxelCount())
      throw std::invalid_argument("a segmentation to be written has a layer of " +
                                  std::to_string(layer.size()) + " voxels, but a geometry of " +
                                  std::to_string(segmentation.geometry.voxelCount()));
}

void forVoxelBytes(const Segmentation& segmentation, const VoxelType& type,
                   const std::function<void(std::span<const std::byte>)>& sink) {
  constexpr std::int64_t chunk = 1 << 16;  // voxels
  const std::size_t layers = segmentation.layers.size(), valueBytes = bytesOf(type.type);
  const std::int64_t count = segmentation.geometry.voxelCount();
  std::vector<std::byte> bytes;
  for (std::int64_t first = 0; first < count; first += chunk) {
    const std::int64_t last = std::min(first + chunk, count);
    bytes.resize(static_cast<std::size_t>(last - first) * layers * valueBytes);
    std::byte* out = bytes.data();
    for (std::int64_t voxel = first; voxel < last; ++voxel)
      for (const auto& layer : segmentation.layers) {
        std::memcpy(out, &layer[voxel], valueBytes);  // the low bytes: two's complement, little endian
        out += valueBytes;
      }
    sink(bytes);
  }
}

void writeFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(file, std::ios::binary);
  if (!out) text::refuse(file, "cannot be created; check its folder and its permissions");
  write(out);
  out.close();
  if (!out) text::refuse(file, "could not be written completely; check the space on the disk");
}

}  // namespace sinew
