#pragma once

#include <charconv>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace sinew {

/// Writes text and numbers to a file, independent of the locale, through a buffer of its own.
class TextWriter {
 public:
  /// @throws std::runtime_error saying why the file cannot be opened
  explicit TextWriter(const std::filesystem::path& file);

  TextWriter& operator<<(std::string_view text) {
    buffer_ += text;
    flushWhenFull();
    return *this;
  }
  TextWriter& operator<<(char c) {
    buffer_ += c;
    return *this;
  }
  TextWriter& operator<<(std::integral auto number) { return append(number); }
  /// The shortest digits that read back as the very number.
  TextWriter& operator<<(double number) { return append(number); }
  /// So many significant digits.
  TextWriter& rounded(double number, int digits) {
    return append(number, std::chars_format::general, digits);
  }

  /// Everything is written. @throws std::runtime_error when it is not
  void finish();

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 20;
  static constexpr std::size_t kLongest = 64;  ///< more than the digits of any number

  template <class... Number>
  TextWriter& append(Number... number) {
    const std::size_t size = buffer_.size();
    buffer_.resize(size + kLongest);
    const auto [end, error] =
        std::to_chars(buffer_.data() + size, buffer_.data() + buffer_.size(), number...);
    buffer_.resize(static_cast<std::size_t>(end - buffer_.data()));
    flushWhenFull();
    return *this;
  }
  void flushWhenFull() {
    if (buffer_.size() >= kFull) flush();
  }
  void flush();

  std::ofstream stream_;
  std::string buffer_;
};

}  // namespace sinew
