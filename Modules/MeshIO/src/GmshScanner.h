#pragma once

#include "FileFailure.h"

#include <algorithm>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace sinew {

/// Goes through the bytes of a .msh file: words and lines of its text, and the numbers of its binary
/// sections.
class GmshScanner {
 public:
  GmshScanner(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

  bool binary = false;  ///< whether `number` takes bytes

  /// @throws std::runtime_error naming the file and the line
  [[noreturn]] void damaged(const std::string& what) const {
    const auto line = 1 + std::ranges::count(bytes_.substr(0, at_), '\n');
    fail(file_, "line " + std::to_string(line) + ": " + what);
  }

  /// The next word, behind white space; empty at the end.
  std::string_view word() {
    at_ = std::min(bytes_.find_first_not_of(kWhite, at_), bytes_.size());
    const std::size_t begin = at_;
    at_ = std::min(bytes_.find_first_of(kWhite, at_), bytes_.size());
    return bytes_.substr(begin, at_ - begin);
  }

  /// What is left of the line.
  std::string_view line() {
    const std::size_t begin = at_, end = std::min(bytes_.find('\n', at_), bytes_.size());
    at_ = std::min(end + 1, bytes_.size());
    return bytes_.substr(begin, end - begin);
  }

  template <class Number>
  Number text() {
    at_ = std::min(bytes_.find_first_not_of(kWhite, at_), bytes_.size());
    Number value{};
    const auto [end, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc()) damaged(at_ < bytes_.size() ? "expected a number" : "the file ends too early");
    at_ = static_cast<std::size_t>(end - bytes_.data());
    return value;
  }

  /// A number of a section that may be binary.
  template <class Number>
  Number number() {
    if (!binary) return text<Number>();
    if (bytes_.size() - at_ < sizeof(Number)) damaged("the file ends too early");
    Number value{};
    std::memcpy(&value, bytes_.data() + at_, sizeof(Number));
    at_ += sizeof(Number);
    return value;
  }

  /// How many things follow. @param leastBytes  of one of them
  std::size_t count(std::size_t leastBytes) {
    const auto claimed = text<std::int64_t>();
    if (claimed < 0 || static_cast<std::uint64_t>(claimed) > (bytes_.size() - at_) / leastBytes)
      damaged("promises " + std::to_string(claimed) + " entries, which the file is too short for");
    line();
    return static_cast<std::size_t>(claimed);
  }

  /// Takes `$End<section>`.
  void end(std::string_view section) {
    if (const std::string_view found = word(); found != "$End" + std::string(section))
      damaged("expected $End" + std::string(section));
    line();
  }

  /// What is left of a section. Goes behind its `$End<section>`.
  std::string_view rest(std::string_view section) {
    const std::size_t begin = at_, end = bytes_.find("$End" + std::string(section), at_);
    if (end == bytes_.npos) damaged("the section has no $End" + std::string(section));
    at_ = end;
    line();
    return bytes_.substr(begin, end - begin);
  }

 private:
  static constexpr std::string_view kWhite = " \t\r\n\v\f";
  std::string_view bytes_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

}  // namespace sinew
