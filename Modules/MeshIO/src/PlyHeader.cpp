#include "PlyHeader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace sinew {
namespace {

constexpr std::array<std::pair<std::string_view, PlyKind>, 16> kKinds{{{"char", PlyKind::Int8},
                                                                       {"int8", PlyKind::Int8},
                                                                       {"uchar", PlyKind::UInt8},
                                                                       {"uint8", PlyKind::UInt8},
                                                                       {"short", PlyKind::Int16},
                                                                       {"int16", PlyKind::Int16},
                                                                       {"ushort", PlyKind::UInt16},
                                                                       {"uint16", PlyKind::UInt16},
                                                                       {"int", PlyKind::Int32},
                                                                       {"int32", PlyKind::Int32},
                                                                       {"uint", PlyKind::UInt32},
                                                                       {"uint32", PlyKind::UInt32},
                                                                       {"float", PlyKind::Float32},
                                                                       {"float32", PlyKind::Float32},
                                                                       {"double", PlyKind::Float64},
                                                                       {"float64", PlyKind::Float64}}};
constexpr std::array<std::pair<std::string_view, PlyEncoding>, 3> kEncodings{
    {{"ascii", PlyEncoding::Ascii},
     {"binary_little_endian", PlyEncoding::LittleEndian},
     {"binary_big_endian", PlyEncoding::BigEndian}}};

template <class Table>
auto find(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table, name, [](const auto& row) { return row.first; });
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> words;
  for (auto first = line.find_first_not_of(kBlank); first != line.npos;
       first = line.find_first_not_of(kBlank)) {
    line.remove_prefix(first);
    words.push_back(line.substr(0, line.find_first_of(kBlank)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

/// `element NAME ROWS`
std::optional<PlyElement> elementOf(const std::vector<std::string_view>& words) {
  if (words.size() != 3) return std::nullopt;
  PlyElement element{std::string(words[1]), 0, {}};
  const char* end = words[2].data() + words[2].size();
  const auto [stop, error] = std::from_chars(words[2].data(), end, element.rows);
  return stop == end && error == std::errc() ? std::optional(element) : std::nullopt;
}

/// `property KIND NAME` or `property list COUNT_KIND KIND NAME`
std::optional<PlyProperty> propertyOf(const std::vector<std::string_view>& words) {
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return std::nullopt;
  const auto kind = find(kKinds, words[words.size() - 2]),
             count = list ? find(kKinds, words[2]) : std::nullopt;
  if (!kind || (list && !count)) return std::nullopt;
  return PlyProperty{std::string(words.back()), *kind, count};
}

/// Adds a line to the header. @return whether it was understood
bool addLine(const std::vector<std::string_view>& words, std::optional<PlyEncoding>& encoding,
             std::vector<PlyElement>& elements) {
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format") {
    if (words.size() == 3 && words[2] == "1.0") encoding = find(kEncodings, words[1]);
    return encoding.has_value();
  }
  if (words[0] == "element") {
    const auto element = elementOf(words);
    if (element) elements.push_back(*element);
    return element.has_value();
  }
  const auto property = words[0] == "property" && !elements.empty() ? propertyOf(words) : std::nullopt;
  if (property) elements.back().properties.push_back(*property);
  return property.has_value();
}

}  // namespace

PlyHeader parsePlyHeader(std::string_view bytes) {
  std::optional<PlyEncoding> encoding;
  std::vector<PlyElement> elements;
  std::size_t at = 0;
  for (int number = 1;; ++number) {
    const std::size_t end = bytes.find('\n', at);
    if (end == bytes.npos) throw PlyDamaged("its header does not end");
    const std::vector<std::string_view> words = wordsOf(bytes.substr(at, end - at));
    at = end + 1;
    if (number == 1) {
      if (words.size() != 1 || words[0] != "ply") throw PlyDamaged("it does not begin with \"ply\"");
    } else if (words.size() == 1 && words[0] == "end_header") {
      break;
    } else if (!addLine(words, encoding, elements)) {
      throw PlyDamaged("line " + std::to_string(number) + " of its header is not understood");
    }
  }
  if (!encoding) throw PlyDamaged("its header names no format");
  return {*encoding, std::move(elements), at};
}

}  // namespace sinew
