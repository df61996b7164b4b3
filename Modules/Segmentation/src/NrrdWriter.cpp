#include "DeflateWriter.h"
#include "Text.h"
#include "VoxelFile.h"

// https://teem.sourceforge.net/nrrd/format.html

namespace sinew {

namespace {

std::string_view nrrdName(ValueType type) {
  switch (type) {
    case ValueType::UInt8:
      return "unsigned char";
    case ValueType::Int16:
      return "short";
    case ValueType::UInt16:
      return "unsigned short";
    default:
      return "int";
  }
}

std::string formatVector(const Eigen::Vector3d& v) {
  std::string result = "(";
  for (int axis = 0; axis < 3; ++axis) result.append(axis ? "," : "").append(text::format(v[axis]));
  return result.append(")");
}

/// A header has no way to write a carriage return or a null: they become spaces.
std::string escape(std::string_view value) {
  std::string result;
  for (const char c : value) {
    if (c == '\n')
      result += "\\n";
    else if (c == '\\')
      result += "\\\\";
    else if (c == '\r' || c == '\0')
      result += ' ';
    else
      result += c;
  }
  return result;
}

std::string nrrdHeader(const Segmentation& segmentation, const VoxelType& type,
                       const std::vector<std::pair<std::string, std::string>>& keys) {
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
  field("type", std::string(nrrdName(type.type)));
  field("dimension", list ? "4" : "3");
  field("space", "left-posterior-superior");
  field("sizes", sizes);
  field("space directions", directions);
  field("kinds", list ? "list domain domain domain" : "domain domain domain");
  if (bytesOf(type.type) > 1) field("endian", "little");
  field("encoding", "gzip");
  field("space origin", formatVector(geometry.origin));
  for (const auto& [key, value] : keys)
    header.append(escape(key)).append(":=").append(escape(value)).append("\n");
  return header + "\n";
}

}  // namespace

void writeNrrd(const Segmentation& segmentation, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& keys) {
  requireWritable(segmentation);
  writeFile(file, [&](std::ostream& out) {
    const VoxelType& type = smallestVoxelType(segmentation);
    out << nrrdHeader(segmentation, type, keys);
    DeflateWriter gzip(out, Wrapper::Gzip);
    forVoxelBytes(segmentation, type, [&](std::span<const std::byte> bytes) { gzip.write(bytes); });
    gzip.finish();
  });
}

}  // namespace sinew
