#include "GuardedXmlParser.h"

#include <vtkInputStream.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <istream>
#include <string_view>

namespace sinew {
namespace {

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
  for (const char** at = attributes; *at != nullptr; at += 2) notePromise(at[0], at[1]);
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

bool GuardedXmlParser::blocksAreSound(vtkXMLDataElement* array) {
  const char* format = array->GetAttribute("format");
  if (Compressor == nullptr || format == nullptr || std::string_view(format) == "ascii") return true;
  if (std::string_view(format) == "appended") {
    vtkTypeInt64 offset = 0;
    array->GetScalarAttribute("offset", offset);
    DataStream = AppendedDataStream;
    SeekG(AppendedDataPosition + offset);
  } else {
    DataStream = InlineDataStream;
    SeekInlineDataPosition(array);
  }
  // Three numbers: blocks, bytes of a block, bytes of the last block where they are fewer.
  const std::size_t wordBytes = static_cast<std::size_t>(HeaderType) / 8;
  std::array<unsigned char, 3 * sizeof(std::uint64_t)> bytes{};
  DataStream->SetStream(Stream);
  DataStream->StartReading();
  const bool whole = DataStream->Read(bytes.data(), 3 * wordBytes) == 3 * wordBytes;
  DataStream->EndReading();
  if (!whole) return false;
  PerformByteSwap(bytes.data(), 3, wordBytes);
  std::array<std::uint64_t, 3> words{};
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t w = 0; w < words.size(); ++w) std::memcpy(&words[w], &bytes[w * wordBytes], wordBytes);
  const auto [blocks, size, last] = words;
  if (blocks == 0) return true;
  const double sizes = static_cast<double>(blocks) * static_cast<double>(wordBytes);
  const double content = static_cast<double>(blocks - 1) * static_cast<double>(size) +
                         static_cast<double>(last > 0 ? last : size);
  return size > 0 && last <= size && sizes <= fileBytes_ && content <= kBestCompression * fileBytes_;
}

}  // namespace sinew
