#pragma once

#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Small text tools, all independent of the locale.
namespace sinew::text {

/// Without white space at both ends.
std::string_view trim(std::string_view text);

/// The words between runs of white space.
std::vector<std::string_view> words(std::string_view text);

/// The pieces between separators; n separators give n + 1 pieces.
std::vector<std::string_view> split(std::string_view text, char separator);

std::string lower(std::string_view text);

/// The whole text as a number; nothing when any of it is no number, or does not fit. Reads nan and inf.
template <class Number>
std::optional<Number> number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Shortest decimal text that reads back as the same number.
std::string format(double value);

/// The same text when it is UTF-8, else read as Latin-1: what a name becomes before anyone prints it.
std::string toUtf8(std::string_view text);

/// For quoting file content in a message: control characters become spaces, long text is cut.
std::string printable(std::string_view text);

/// Throws std::runtime_error "FILE: what", one line; FILE as the user typed it.
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view what);

}  // namespace sinew::text
