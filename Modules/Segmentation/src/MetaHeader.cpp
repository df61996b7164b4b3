#include "ImageFormats.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

// https://itk.org/Wiki/ITK/MetaIO/Documentation

namespace sinew {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestLine = 4000;  // bytes; MetaIO has fixed buffers

struct MetaFields {
  std::map<std::string, std::string> fields;
  std::uint64_t bytes = 0;  ///< of the header
};

MetaFields readMetaFields(const fs::path& file) {
  MetaFields header;
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  while (std::getline(stream, line)) {
    header.bytes += line.size() + 1;
    const auto equals = line.find('=');
    if (line.size() > kLongestLine) break;
    if (equals == std::string::npos) continue;
    const std::string key(text::trim(line.substr(0, equals)));
    header.fields.insert_or_assign(key, std::string(text::trim(line.substr(equals + 1))));
    if (key == "ElementDataFile") return header;
  }
  text::refuse(file, "its MetaImage header has no ElementDataFile; export the segmentation again");
}

std::string_view field(const MetaFields& header, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto found = header.fields.find(std::string(name)); found != header.fields.end())
      return found->second;
  return {};
}

bool isTrue(std::string_view value) {
  return value.starts_with('T') || value.starts_with('t') || value == "1";
}

template <class Number>
std::vector<Number> numbers(const fs::path& file, const MetaFields& header,
                            std::initializer_list<std::string_view> names) {
  std::vector<Number> result;
  for (const std::string_view word : text::words(field(header, names))) {
    const auto value = text::number<Number>(word);
    if (!value)
      text::refuse(file, "its MetaImage field " + std::string(*names.begin()) + " holds `" +
                             text::printable(word) +
                             "`; correct the header or export the segmentation again");
    result.push_back(*value);
  }
  return result;
}

std::vector<std::int64_t> sizes(const fs::path& file, const MetaFields& header) {
  auto result = numbers<std::int64_t>(file, header, {"DimSize"});
  const auto dimension = text::number<std::size_t>(field(header, {"NDims"}));
  if (!dimension || *dimension != result.size() || result.empty() || result.size() > 10)
    text::refuse(
        file, "its MetaImage fields NDims and DimSize are missing or differ; export the segmentation again");
  return result;
}

void checkGeometry(const fs::path& file, const MetaFields& header, std::size_t dimension) {
  for (const auto* name : {"ElementSpacing", "ElementSize"}) {
    const auto spacing = numbers<double>(file, header, {name});
    if (!spacing.empty() && spacing.size() != dimension)
      text::refuse(file, "its MetaImage field " + std::string(name) +
                             " needs one number per axis; correct the header");
    for (std::size_t axis = 0; axis < std::min<std::size_t>(spacing.size(), 3); ++axis)
      requireSpacing(file, spacing[axis], static_cast<int>(axis), name);
  }
  const auto matrix = numbers<double>(file, header, {"TransformMatrix", "Rotation", "Orientation"});
  if (!matrix.empty() && matrix.size() != dimension * dimension)
    text::refuse(file,
                 "its MetaImage field TransformMatrix needs one number per pair of axes; correct the header");
  if (matrix.size() == 9)
    requireDirections(file, Eigen::Map<const Eigen::Matrix3d>(matrix.data()), "MetaImage TransformMatrix");
  for (const double value : numbers<double>(file, header, {"Offset", "Position", "Origin"}))
    if (!std::isfinite(value))
      text::refuse(file, "its MetaImage field Offset is not a number; correct the header");
}

ValueType valueType(const fs::path& file, std::string_view name) {
  struct Type {
    std::string_view name;
    ValueType type;
  };
  constexpr std::array types{
      Type{"MET_CHAR", ValueType::Int8},       Type{"MET_UCHAR", ValueType::UInt8},
      Type{"MET_SHORT", ValueType::Int16},     Type{"MET_USHORT", ValueType::UInt16},
      Type{"MET_INT", ValueType::Int32},       Type{"MET_UINT", ValueType::UInt32},
      Type{"MET_LONG", ValueType::Int32},      Type{"MET_ULONG", ValueType::UInt32},
      Type{"MET_LONG_LONG", ValueType::Int64}, Type{"MET_ULONG_LONG", ValueType::UInt64},
      Type{"MET_FLOAT", ValueType::Float32},   Type{"MET_DOUBLE", ValueType::Float64}};
  for (const Type& type : types)
    if (type.name == name) return type.type;
  text::refuse(file,
               "its MetaImage ElementType is `" + text::printable(name) + "`; save it with an integer type");
}

/// The one file with the voxels.
fs::path dataFile(const fs::path& file, std::string_view name) {
  if (text::lower(name) == "local") return file;
  if (name.starts_with("LIST") || name.find('%') != std::string_view::npos)
    text::refuse(file, "its voxels lie in many files; save it as one .mha or .seg.nrrd file");
  const fs::path data = file.parent_path() / fs::path(name);
  if (!fs::is_regular_file(data))
    text::refuse(file,
                 "its data file `" + text::printable(name) + "` is missing; put it next to this header");
  return data;
}

/// CompressedDataSize is not used: files in the wild give it wrong, and the voxels go on to the file's end.
ImagePayload payload(const fs::path& file, const MetaFields& header, std::span<const std::int64_t> shape) {
  if (header.fields.contains("BinaryData") && !isTrue(field(header, {"BinaryData"})))
    text::refuse(file, "stores its voxels as text (BinaryData = False); save it as binary");
  ImagePayload result{.file = dataFile(file, field(header, {"ElementDataFile"})),
                      .compressed = isTrue(field(header, {"CompressedData"}))};
  result.type = valueType(file, field(header, {"ElementType"}));
  result.bytes = volumeBytes(file, shape, bytesOf(result.type));
  result.swapped = isTrue(field(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}));
  // -1: the voxels are what the file ends with.
  const auto headerSize = text::number<std::int64_t>(field(header, {"HeaderSize"})).value_or(0);
  if (result.file == file)
    result.offset = header.bytes;
  else if (headerSize >= 0)
    result.offset = static_cast<std::uint64_t>(headerSize);
  else if (!result.compressed)
    result.offset =
        fs::file_size(result.file) - std::min<std::uint64_t>(fs::file_size(result.file), result.bytes);
  return result;
}

}  // namespace

ImageHeader readMetaHeader(const fs::path& file) {
  const MetaFields fields = readMetaFields(file);
  const auto shape = sizes(file, fields);
  requireVolume(file, shape);
  const auto channels = numbers<std::int64_t>(file, fields, {"ElementNumberOfChannels"});
  if (!channels.empty() && channels.front() != 1) refuseComponents(file, "vectors or colours");
  checkGeometry(file, fields, shape.size());
  return {.format = ImageFormat::Meta, .payload = payload(file, fields, shape)};
}

}  // namespace sinew
