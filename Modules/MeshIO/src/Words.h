#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace sinew {

/// The words of a text, one after the other, between white space; independent of the locale.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kWhite), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kWhite));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  static constexpr std::string_view kWhite = " \t\r\n\v\f";
  std::string_view rest_;
};

/// The whole word as a number; nothing when any of it is no number, or does not fit.
template <class Number>
std::optional<Number> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace sinew
