#include "sinew/Segmentation/WriteSegmentation.h"

#include "GzipWriter.h"
#include "SlicerKeys.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

// https://teem.sourceforge.net/nrrd/format.html

namespace sinew {

namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

/// NRRD's name and the bytes of the type that the voxels are written in.
struct VoxelType {
  std::string_view name;
  int bytes;
  std::int32_t least;
  std::int32_t most;
};

/// Slicer reads no 64-bit and no signed 8-bit labels.
constexpr std::array kVoxelTypes{VoxelType{"unsigned char", 1, 0, 255}, VoxelType{"short", 2, -32768, 32767},
                                 VoxelType{"unsigned short", 2, 0, 65535},
                                 VoxelType{"int", 4, INT32_MIN, INT32_MAX}};

void requireWritable(const Segmentation& segmentation) {
  if (segmentation.layers.empty()) throw std::invalid_argument("writeSegmentation: there is no layer");
  for (const auto& layer : segmentation.layers)
    if (static_cast<std::int64_t>(layer.size()) != segmentation.geometry.voxelCount())
      throw std::invalid_argument("writeSegmentation: a layer has " + std::to_string(layer.size()) +
                                  " voxels, the geometry " +
                                  std::to_string(segmentation.geometry.voxelCount()));
}

const VoxelType& smallestType(const Segmentation& segmentation) {
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

std::string formatVector(const Eigen::Vector3d& v) {
  std::string result = "(";
  for (int axis = 0; axis < 3; ++axis) result.append(axis ? "," : "").append(text::format(v[axis]));
  return result.append(")");
}

std::string escape(std::string_view value) {
  std::string result;
  for (const char c : value) {
    if (c == '\n')
      result += "\\n";
    else if (c == '\\')
      result += "\\\\";
    else
      result += c;
  }
  return result;
}

std::string nrrdHeader(const Segmentation& segmentation, const VoxelType& type) {
  const ImageGeometry& geometry = segmentation.geometry;
  const std::size_t layers = segmentation.layers.size();
  const bool list = layers > 1;
  std::string header = "NRRD0004\n";
  const auto field = [&](std::string_view name, const std::string& value) {
    header.append(name).append(": ").append(value).append("\n");
  };
  std::string sizes, directions;
  if (list) {
    sizes = std::to_string(layers) + " ";
    directions = "none ";
  }
  for (int axis = 0; axis < 3; ++axis) {
    const char* between = axis ? " " : "";
    sizes.append(between).append(std::to_string(geometry.size[axis]));
    directions.append(between).append(formatVector(geometry.direction.col(axis) * geometry.spacing[axis]));
  }
  field("type", std::string(type.name));
  field("dimension", list ? "4" : "3");
  field("space", "left-posterior-superior");
  field("sizes", sizes);
  field("space directions", directions);
  field("kinds", list ? "list domain domain domain" : "domain domain domain");
  if (type.bytes > 1) field("endian", "little");
  field("encoding", "gzip");
  field("space origin", formatVector(geometry.origin));
  for (const auto& [key, value] : slicer::writeKeys(segmentation))
    header.append(escape(key)).append(":=").append(escape(value)).append("\n");
  return header + "\n";
}

/// The voxels of all layers, layer fastest, in chunks of a few rows.
void writeVoxels(const Segmentation& segmentation, const VoxelType& type, GzipWriter& gzip) {
  constexpr std::int64_t chunk = 1 << 16;  // voxels
  const std::size_t layers = segmentation.layers.size();
  const std::int64_t count = segmentation.geometry.voxelCount();
  std::vector<std::byte> bytes;
  for (std::int64_t first = 0; first < count; first += chunk) {
    const std::int64_t last = std::min(first + chunk, count);
    bytes.resize(static_cast<std::size_t>(last - first) * layers * type.bytes);
    std::byte* out = bytes.data();
    for (std::int64_t voxel = first; voxel < last; ++voxel)
      for (const auto& layer : segmentation.layers) {
        std::memcpy(out, &layer[voxel], type.bytes);  // the low bytes: two's complement, little endian
        out += type.bytes;
      }
    gzip.write(bytes);
  }
  gzip.finish();
}

}  // namespace

void writeSegmentation(const Segmentation& segmentation, const std::filesystem::path& file) {
  requireWritable(segmentation);
  std::ofstream out(file, std::ios::binary);
  if (!out) text::refuse(file, "cannot be created; check its folder and its permissions");
  const VoxelType& type = smallestType(segmentation);
  out << nrrdHeader(segmentation, type);
  GzipWriter gzip(out);
  writeVoxels(segmentation, type, gzip);
  out.close();
  if (!out) text::refuse(file, "could not be written completely; check the space on the disk");
}

}  // namespace sinew
