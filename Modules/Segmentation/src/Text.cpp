#include "Text.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace sinew::text {

namespace {

constexpr std::string_view kWhite = " \t\r\n\v\f";
constexpr std::size_t kLongestQuote = 200;

/// Bytes of the UTF-8 sequence at the front of the text; 0 when there is none.
std::size_t utf8SequenceLength(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  if (length < 3) return length;
  // Overlong forms, surrogates and values beyond U+10FFFF are told by the second byte.
  const auto second = static_cast<unsigned char>(text[1]);
  const bool sound = lead == 0xE0   ? second >= 0xA0
                     : lead == 0xED ? second < 0xA0
                     : lead == 0xF0 ? second >= 0x90
                     : lead == 0xF4 ? second < 0x90
                                    : true;
  return sound ? length : 0;
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8SequenceLength(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kWhite);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kWhite) - first + 1);
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> result;
  while (true) {
    const auto first = text.find_first_not_of(kWhite);
    if (first == std::string_view::npos) return result;
    text.remove_prefix(first);
    const auto length = std::min(text.find_first_of(kWhite), text.size());
    result.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  while (true) {
    const auto end = text.find(separator);
    result.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return result;
    text.remove_prefix(end + 1);
  }
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return c < 0x80 ? std::tolower(c) : c; });
  return result;
}

std::string format(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string toUtf8(std::string_view text) {
  if (isUtf8(text)) return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result = toUtf8(trim(text));
  std::ranges::replace_if(
      result, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  if (result.size() <= kLongestQuote) return result;
  std::size_t end = kLongestQuote;
  while ((static_cast<unsigned char>(result[end]) & 0xC0) == 0x80) --end;
  return result.substr(0, end) + "...";
}

void refuse(const std::filesystem::path& file, std::string_view what) {
  throw std::runtime_error(file.string() + ": " + std::string(what));
}

}  // namespace sinew::text
