#include "DeflateWriter.h"
#include "Text.h"
#include "VoxelFile.h"

#include <sstream>

// https://itk.org/Wiki/ITK/MetaIO/Documentation

namespace sinew {

namespace {

namespace fs = std::filesystem;

std::string_view metaName(ValueType type) {
  switch (type) {
    case ValueType::UInt8:
      return "MET_UCHAR";
    case ValueType::Int16:
      return "MET_SHORT";
    case ValueType::UInt16:
      return "MET_USHORT";
    default:
      return "MET_INT";
  }
}

template <class Values>
std::string joined(const Values& values) {
  std::string result;
  for (const double value : values) result.append(result.empty() ? "" : " ").append(text::format(value));
  return result;
}

/// TransformMatrix holds the axes one after the other.
std::string metaHeader(const ImageGeometry& geometry, const VoxelType& type, std::size_t packedBytes) {
  std::string header;
  const auto field = [&](std::string_view name, std::string_view value) {
    header.append(name).append(" = ").append(value).append("\n");
  };
  field("ObjectType", "Image");
  field("NDims", "3");
  field("BinaryData", "True");
  field("BinaryDataByteOrderMSB", "False");
  field("CompressedData", "True");
  field("CompressedDataSize", std::to_string(packedBytes));
  field("TransformMatrix", joined(geometry.direction.reshaped()));
  field("Offset", joined(geometry.origin));
  field("CenterOfRotation", "0 0 0");
  field("ElementSpacing", joined(geometry.spacing));
  field("DimSize", joined(geometry.size));
  field("ElementType", metaName(type.type));
  field("ElementDataFile", "LOCAL");
  return header;
}

std::string packedVoxels(const Segmentation& segmentation, const VoxelType& type) {
  std::ostringstream packed;
  DeflateWriter writer(packed, Wrapper::Zlib);
  forVoxelBytes(segmentation, type, [&](std::span<const std::byte> bytes) { writer.write(bytes); });
  writer.finish();
  return std::move(packed).str();
}

}  // namespace

void writeMeta(const Segmentation& segmentation, const fs::path& file) {
  const VoxelType& type = smallestVoxelType(segmentation);
  const std::string voxels = packedVoxels(segmentation, type);
  writeFile(file, [&](std::ostream& out) {
    out << metaHeader(segmentation.geometry, type, voxels.size()) << voxels;
  });
}

}  // namespace sinew
