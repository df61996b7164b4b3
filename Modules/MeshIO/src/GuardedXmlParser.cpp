#include "GuardedXmlParser.h"

#include <vtkInputStream.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <istream>
#include <string_view>

namespace sinew {
namespace {

constexpr std::array<std::string_view, 12> kTypes{"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                                  "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
constexpr int kMostNested = 32;
constexpr int kMostComponents = 64;
/// A compressed file holds at most so many bytes, and so many values, in one of its own.
constexpr double kBestCompression = 1 << 14;

double bytesIn(std::istream& stream) {
  const auto place = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto end = stream.tellg();
  stream.seekg(place);
  return static_cast<double>(end);
}

}  // namespace

vtkStandardNewMacro(GuardedXmlParser);

int GuardedXmlParser::Parse() {
  fileBytes_ = bytesIn(*GetStream());
  const int parsed = vtkXMLDataParser::Parse();
  if (promised_ > kBestCompression * fileBytes_) refusal_ = "promises more values than it can hold";
  if (refusal_.empty()) return parsed;
  vtkErrorMacro(<< refusal_);
  return 0;
}

void GuardedXmlParser::StartElement(const char* name, const char** attributes) {
  if (++depth_ > kMostNested) {
    refusal_ = "its elements are nested too deep";
    return;
  }
  const std::string_view element = name;
  bool typed = element != "DataArray" && element != "Array";
  for (const char** at = attributes; *at != nullptr; at += 2) {
    notePromise(at[0], at[1]);
    typed = typed || (std::string_view(at[0]) == "type" && std::ranges::find(kTypes, at[1]) != kTypes.end());
  }
  if (!typed) refusal_ = "an array has no known type";
  vtkXMLDataParser::StartElement(name, attributes);
}

void GuardedXmlParser::EndElement(const char* name) {
  if (depth_-- <= kMostNested) vtkXMLDataParser::EndElement(name);
}

void GuardedXmlParser::notePromise(const std::string& attribute, const char* value) {
  if (!attribute.starts_with("NumberOf")) return;
  const double number = std::strtod(value, nullptr);
  if (attribute != "NumberOfComponents")
    promised_ += std::abs(number);
  else if (!(number >= 0 && number <= kMostComponents))
    refusal_ = "an array has " + std::string(value).substr(0, 40) + " components";
}

void GuardedXmlParser::goToData(vtkXMLDataElement* array) {
  if (std::string_view(array->GetAttribute("format")) == "appended") {
    vtkTypeInt64 offset = 0;
    array->GetScalarAttribute("offset", offset);
    DataStream = AppendedDataStream;
    SeekG(AppendedDataPosition + offset);
  } else {
    DataStream = InlineDataStream;
    SeekInlineDataPosition(array);
  }
  DataStream->SetStream(Stream);
}

std::vector<std::uint64_t> GuardedXmlParser::readWords(std::size_t count) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t wordBytes = static_cast<std::size_t>(HeaderType) / 8;
  std::vector<unsigned char> bytes(count * wordBytes);
  if (DataStream->Read(bytes.data(), bytes.size()) != bytes.size()) return {};
  PerformByteSwap(bytes.data(), count, wordBytes);
  std::vector<std::uint64_t> words(count);
  for (std::size_t w = 0; w < count; ++w) std::memcpy(&words[w], &bytes[w * wordBytes], wordBytes);
  return words;
}

bool GuardedXmlParser::sizesAreSound() {
  const std::vector<std::uint64_t> sizes =
      readWords(3);  // blocks, bytes of each, bytes of a shorter last one
  if (sizes.empty()) return false;
  const auto blocks = static_cast<double>(sizes[0]), size = static_cast<double>(sizes[1]),
             last = static_cast<double>(sizes[2]);
  if (blocks == 0) return true;
  const double content = (blocks - 1) * size + (last > 0 ? last : size);
  if (size == 0 || last > size || blocks > fileBytes_ || content > kBestCompression * fileBytes_)
    return false;
  const std::vector<std::uint64_t> packed = readWords(sizes[0]);
  return !packed.empty() && std::ranges::all_of(packed, [this](std::uint64_t bytes) {
    return static_cast<double>(bytes) <= fileBytes_;
  });
}

bool GuardedXmlParser::blocksAreSound(vtkXMLDataElement* array) {
  const char* format = array->GetAttribute("format");
  if (Compressor == nullptr || format == nullptr || std::string_view(format) == "ascii") return true;
  goToData(array);
  DataStream->StartReading();
  const bool sound = sizesAreSound();
  DataStream->EndReading();
  return sound;
}

bool GuardedXmlParser::readTexts(vtkXMLDataElement* element, vtkIdType at, vtkIdType count,
                                 vtkStringArray* texts) {
  std::string characters(std::size_t{1} << 20, '\0');
  const char* format = element->GetAttribute("format");
  vtkTypeInt64 offset = 0;
  const bool appended = format != nullptr && std::string_view(format) == "appended" &&
                        element->GetScalarAttribute("offset", offset) != 0;
  const int ascii = format == nullptr || std::string_view(format) == "ascii";
  const std::size_t found = appended
                                ? ReadAppendedData(offset, characters.data(), 0, characters.size())
                                : ReadInlineData(element, ascii, characters.data(), 0, characters.size());
  characters.resize(found);
  std::size_t begin = 0;
  for (vtkIdType t = 0; t < count; ++t) {
    const std::size_t end = characters.find('\0', begin);
    if (end == std::string::npos) return false;
    texts->SetValue(at + t, characters.substr(begin, end - begin));
    begin = end + 1;
  }
  return true;
}

}  // namespace sinew
