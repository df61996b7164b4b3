#include "ImageFormats.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

// https://teem.sourceforge.net/nrrd/format.html

namespace sinew {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestHeader = 64 << 20;  // bytes

struct NrrdFields {
  std::map<std::string, std::string> fields;  ///< lower-case name -> value
  std::map<std::string, std::string> keys;    ///< key/value pairs
  std::uint64_t bytes = 0;                    ///< of the header with its blank line
};

/// `\\n` and `\\\\` stand for a line end and a backslash.
std::string unescape(std::string_view value) {
  std::string result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const char next = i + 1 < value.size() ? value[i + 1] : '\0';
    if (value[i] == '\\' && (next == 'n' || next == '\\')) {
      result += next == 'n' ? '\n' : '\\';
      ++i;
    } else {
      result += value[i];
    }
  }
  return result;
}

NrrdFields readNrrdFields(const fs::path& file) {
  NrrdFields header;
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  header.bytes = line.size() + 1;
  while (std::getline(stream, line)) {
    header.bytes += line.size() + 1;
    if (header.bytes > kLargestHeader)
      text::refuse(file, "has no end of its NRRD header (a blank line); export the segmentation again");
    if (header.keys.size() > kMostNrrdKeys)
      text::refuse(file, "has more than " + std::to_string(kMostNrrdKeys) +
                             " key/value pairs in its NRRD header; save it as a plain label map");
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) break;
    if (line.starts_with('#')) continue;
    const auto key = line.find(":="), name = line.find(": ");
    if (key < name)
      header.keys.insert_or_assign(unescape(line.substr(0, key)), unescape(line.substr(key + 2)));
    else if (name != std::string::npos)
      header.fields.insert_or_assign(text::lower(line.substr(0, name)),
                                     std::string(text::trim(line.substr(name + 2))));
  }
  return header;
}

/// Value of a field under any of its names; empty when it is missing.
std::string_view field(const NrrdFields& header, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto found = header.fields.find(std::string(name)); found != header.fields.end())
      return found->second;
  return {};
}

std::vector<std::int64_t> sizes(const fs::path& file, const NrrdFields& header) {
  std::vector<std::int64_t> result;
  for (const std::string_view word : text::words(field(header, {"sizes"}))) {
    const auto size = text::number<std::int64_t>(word);
    if (!size)
      text::refuse(file, "its NRRD field `sizes` is no list of whole numbers; export the segmentation again");
    result.push_back(*size);
  }
  const auto dimension = text::number<std::size_t>(field(header, {"dimension"}));
  if (!dimension || *dimension != result.size() || result.empty())
    text::refuse(
        file, "its NRRD fields `dimension` and `sizes` are missing or differ; export the segmentation again");
  return result;
}

/// NRRD's names for the types of values.
ValueType valueType(const fs::path& file, const NrrdFields& header) {
  struct Type {
    std::string_view name;
    ValueType type;
  };
  static constexpr std::array types{
      Type{"signed char", ValueType::Int8},
      Type{"int8", ValueType::Int8},
      Type{"int8_t", ValueType::Int8},
      Type{"uchar", ValueType::UInt8},
      Type{"unsigned char", ValueType::UInt8},
      Type{"uint8", ValueType::UInt8},
      Type{"uint8_t", ValueType::UInt8},
      Type{"short", ValueType::Int16},
      Type{"short int", ValueType::Int16},
      Type{"signed short", ValueType::Int16},
      Type{"signed short int", ValueType::Int16},
      Type{"int16", ValueType::Int16},
      Type{"int16_t", ValueType::Int16},
      Type{"ushort", ValueType::UInt16},
      Type{"unsigned short", ValueType::UInt16},
      Type{"unsigned short int", ValueType::UInt16},
      Type{"uint16", ValueType::UInt16},
      Type{"uint16_t", ValueType::UInt16},
      Type{"int", ValueType::Int32},
      Type{"signed int", ValueType::Int32},
      Type{"int32", ValueType::Int32},
      Type{"int32_t", ValueType::Int32},
      Type{"uint", ValueType::UInt32},
      Type{"unsigned int", ValueType::UInt32},
      Type{"uint32", ValueType::UInt32},
      Type{"uint32_t", ValueType::UInt32},
      Type{"longlong", ValueType::Int64},
      Type{"long long", ValueType::Int64},
      Type{"long long int", ValueType::Int64},
      Type{"signed long long", ValueType::Int64},
      Type{"signed long long int", ValueType::Int64},
      Type{"int64", ValueType::Int64},
      Type{"int64_t", ValueType::Int64},
      Type{"ulonglong", ValueType::UInt64},
      Type{"unsigned long long", ValueType::UInt64},
      Type{"unsigned long long int", ValueType::UInt64},
      Type{"uint64", ValueType::UInt64},
      Type{"uint64_t", ValueType::UInt64},
      Type{"float", ValueType::Float32},
      Type{"double", ValueType::Float64},
  };
  const std::string name = text::lower(field(header, {"type"}));
  const auto found = std::ranges::find(types, name, &Type::name);
  if (found != types.end()) return found->type;
  text::refuse(file, "its NRRD type is `" + text::printable(name) + "`; save it with an integer type");
}

/// Axes of these kinds hold the components of a pixel, not a direction in space.
bool isRangeKind(std::string_view kind) {
  return !kind.empty() && kind != "domain" && kind != "space" && kind != "time" && kind != "???" &&
         kind != "none";
}

void checkSpacings(const fs::path& file, const NrrdFields& header,
                   const std::vector<std::string_view>& kinds) {
  int axis = 0;
  const auto spacings = text::words(field(header, {"spacings"}));
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    if (i < kinds.size() && isRangeKind(kinds[i])) continue;
    if (const auto value = text::number<double>(spacings[i]))
      requireSpacing(file, *value, axis, "NRRD `spacings`");
    ++axis;
  }
}

/// `(x,y,z) (x,y,z) (x,y,z)`, with `none` for the components of a pixel.
void checkDirections(const fs::path& file, const NrrdFields& header) {
  std::vector<Eigen::Vector3d> axes;
  std::string_view rest = field(header, {"space directions"});
  while (true) {
    const auto open = rest.find('('), close = rest.find(')', open);
    if (open == std::string_view::npos || close == std::string_view::npos) break;
    const auto numbers = text::split(rest.substr(open + 1, close - open - 1), ',');
    rest.remove_prefix(close + 1);
    if (numbers.size() != 3) return;  // a space that is not ours: ITK says what it makes of it
    Eigen::Vector3d axis;
    for (int c = 0; c < 3; ++c) axis[c] = text::number<double>(numbers[c]).value_or(std::nan(""));
    requireSpacing(file, axis.norm(), static_cast<int>(axes.size()), "length of its NRRD `space directions`");
    axes.push_back(axis);
  }
  if (axes.size() != 3) return;
  Eigen::Matrix3d matrix;
  matrix << axes[0], axes[1], axes[2];
  requireDirections(file, matrix, "NRRD `space directions`");
}

/// The one file with the voxels; empty when a list or a pattern names many.
std::optional<fs::path> dataFile(const fs::path& file, const NrrdFields& header) {
  const std::string_view name = field(header, {"data file", "datafile"});
  if (name.empty()) return file;
  if (name.starts_with("LIST") || name.find('%') != std::string_view::npos) return std::nullopt;
  const fs::path path = file.parent_path() / fs::path(name);
  if (!fs::is_regular_file(path))
    text::refuse(file,
                 "its data file `" + text::printable(name) + "` is missing; put it next to this header");
  return path;
}

std::optional<ImagePayload> payload(const fs::path& file, const NrrdFields& header, ValueType type,
                                    std::uint64_t bytes) {
  const std::string encoding = text::lower(field(header, {"encoding"}));
  const bool raw = encoding == "raw", gzip = encoding == "gzip" || encoding == "gz";
  const bool skips = !field(header, {"line skip", "lineskip", "byte skip", "byteskip"}).empty();
  const auto data = dataFile(file, header);
  if (!data || !(raw || gzip) || skips) return std::nullopt;
  return ImagePayload{.file = *data,
                      .offset = data == file ? header.bytes : 0,
                      .compressed = gzip,
                      .bytes = bytes,
                      .type = type,
                      .swapped = text::lower(field(header, {"endian"})) == "big"};
}

}  // namespace

ImageHeader readNrrdHeader(const fs::path& file) {
  const NrrdFields fields = readNrrdFields(file);
  const auto shape = sizes(file, fields);
  const ValueType type = valueType(file, fields);
  const std::uint64_t bytes = volumeBytes(file, shape, bytesOf(type));
  const std::string lowerKinds = text::lower(field(fields, {"kinds"}));
  const auto kinds = text::words(lowerKinds);
  checkSpacings(file, fields, kinds);
  checkDirections(file, fields);
  return {.format = ImageFormat::Nrrd,
          .keys = fields.keys,
          .list = std::ranges::count(kinds, "list") == 1,
          .payload = payload(file, fields, type, bytes)};
}

}  // namespace sinew
