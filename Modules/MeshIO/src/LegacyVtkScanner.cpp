#include "LegacyVtkScanner.h"

#include "FileFailure.h"
#include "Words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>

namespace sinew {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the files are big-endian");

template <class Number>
double take(const char* bytes) {
  std::array<char, sizeof(Number)> turned;
  std::reverse_copy(bytes, bytes + sizeof(Number), turned.begin());
  Number value;
  std::memcpy(&value, turned.data(), sizeof value);
  return static_cast<double>(value);
}

using NumberType = LegacyVtkScanner::NumberType;
template <class Number>
constexpr NumberType numberType(std::string_view name) {
  return {name, sizeof(Number), &take<Number>};
}

constexpr std::array kNumberTypes{numberType<std::int8_t>("char"),
                                  numberType<std::int8_t>("signed_char"),
                                  numberType<std::uint8_t>("unsigned_char"),
                                  numberType<std::int16_t>("short"),
                                  numberType<std::uint16_t>("unsigned_short"),
                                  numberType<std::int32_t>("int"),
                                  numberType<std::uint32_t>("unsigned_int"),
                                  numberType<std::int64_t>("long"),
                                  numberType<std::uint64_t>("unsigned_long"),
                                  numberType<std::int32_t>("vtkidtype"),  // written as int
                                  numberType<std::int64_t>("vtktypeint64"),
                                  numberType<std::uint64_t>("vtktypeuint64"),
                                  numberType<float>("float"),
                                  numberType<double>("double")};

constexpr std::string_view kWhite = " \t\r\n\v\f";

}  // namespace

void LegacyVtkScanner::damaged(const std::string& what) const {
  fail(file_, "damaged or not a legacy VTK file (" + what + ")");
}

std::string_view LegacyVtkScanner::word() {
  const std::size_t begin = std::min(bytes_.find_first_not_of(kWhite, at_), bytes_.size());
  at_ = std::min(bytes_.find_first_of(kWhite, begin), bytes_.size());
  return bytes_.substr(begin, at_ - begin);
}

std::string LegacyVtkScanner::keyword() {
  std::string text(word());
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string_view LegacyVtkScanner::line() {
  const std::size_t begin = at_, end = std::min(bytes_.find('\n', at_), bytes_.size());
  at_ = std::min(end + 1, bytes_.size());
  std::string_view text = bytes_.substr(begin, end - begin);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::int64_t LegacyVtkScanner::count() {
  const auto value = numberOf<std::int64_t>(word());
  if (!value || *value < 0) damaged("expected a number of things");
  return *value;
}

std::vector<double> LegacyVtkScanner::numbers(std::string_view type, std::int64_t count) {
  std::vector<double> values;
  if (binary) {
    const NumberType& number = typeOf(type);
    const char* bytes = takeBytes(count, number.bytes);
    values.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = number.take(bytes + i * number.bytes);
    return values;
  }
  // A number takes a character and one of white space.
  if (static_cast<std::uint64_t>(count) > (bytes_.size() - at_ + 1) / 2) damaged("an array ends too early");
  values.reserve(static_cast<std::size_t>(count));
  while (std::ssize(values) < count) {
    const auto value = numberOf<double>(word());
    if (!value) damaged("expected a number");
    values.push_back(*value);
  }
  return values;
}

std::vector<std::int64_t> LegacyVtkScanner::wholeNumbers(std::string_view type, std::int64_t count) {
  constexpr double kFarthest = 9e15;  // below 2^53 a double has every whole number
  std::vector<std::int64_t> values;
  for (const double value : numbers(type, count)) {
    if (!(value == std::floor(value) && std::abs(value) <= kFarthest)) damaged("expected a whole number");
    values.push_back(static_cast<std::int64_t>(value));
  }
  return values;
}

void LegacyVtkScanner::skip(std::string_view type, std::int64_t count) {
  if (type == "string") {
    line();
    for (std::int64_t i = 0; i < count && at_ < bytes_.size(); ++i)
      binary ? skipBinaryString() : void(line());
  } else if (!binary) {
    for (std::int64_t i = 0; i < count; ++i)
      if (word().empty()) damaged("an array ends too early");
  } else if (type == "bit") {
    takeBytes(count / 8 + (count % 8 != 0), 1);
  } else {
    takeBytes(count, typeOf(type).bytes);
  }
}

const LegacyVtkScanner::NumberType& LegacyVtkScanner::typeOf(std::string_view name) const {
  const auto* type = std::ranges::find(kNumberTypes, name, &NumberType::name);
  if (type == kNumberTypes.end()) damaged("unknown type " + std::string(name.substr(0, 40)));
  return *type;
}

const char* LegacyVtkScanner::takeBytes(std::int64_t count, std::int64_t bytesOfEach) {
  line();
  const std::size_t left = bytes_.size() - at_;
  if (static_cast<std::uint64_t>(count) > left / static_cast<std::size_t>(bytesOfEach))
    damaged("an array ends too early");
  const char* begin = bytes_.data() + at_;
  at_ += static_cast<std::size_t>(count * bytesOfEach);
  return begin;
}

/// Its length comes first: the two highest bits tell whether in 1, 2, 4 or 8 bytes.
void LegacyVtkScanner::skipBinaryString() {
  const auto lead = static_cast<unsigned char>(bytes_[at_]);
  const std::size_t lengthBytes = std::size_t{8} >> (lead >> 6);
  if (bytes_.size() - at_ < lengthBytes) damaged("a text ends too early");
  std::uint64_t length = lead & 0x3F;
  for (std::size_t i = 1; i < lengthBytes; ++i)
    length = length << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
  at_ += lengthBytes;
  if (length > bytes_.size() - at_) damaged("a text ends too early");
  at_ += length;
}

}  // namespace sinew
