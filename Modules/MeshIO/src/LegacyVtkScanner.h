#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Goes through the bytes of a legacy .vtk file: words, and arrays of numbers as text or big-endian bytes.
class LegacyVtkScanner {
 public:
  LegacyVtkScanner(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

  /// A type of numbers, and how to take one of them from its bytes.
  struct NumberType {
    std::string_view name;
    std::int64_t bytes;
    double (*take)(const char*);
  };

  bool binary = false;  ///< whether arrays are bytes

  /// @throws std::runtime_error naming the file
  [[noreturn]] void damaged(const std::string& what) const;

  /// The next word, behind white space; empty at the end.
  std::string_view word();
  /// The next word in lower case.
  std::string keyword();
  /// What is left of the line, which it goes behind.
  std::string_view line();
  /// The next word as a number that is not negative.
  std::int64_t count();

  /// The numbers of an array, which begins behind this line where they are bytes.
  /// @param type  as the file names it: `int`, `unsigned_char`, `vtktypeint64`, ...
  /// Costs no memory for what the file is too short for.
  std::vector<double> numbers(std::string_view type, std::int64_t count);
  /// The same of an array that holds whole numbers only.
  std::vector<std::int64_t> wholeNumbers(std::string_view type, std::int64_t count);
  /// Goes behind an array; here it may also be of `bit` or `string`.
  void skip(std::string_view type, std::int64_t count);

 private:
  /// Goes behind bytes that begin on the next line. @return where they begin
  const char* takeBytes(std::int64_t count, std::int64_t bytesOfEach);
  void skipBinaryString();
  const NumberType& typeOf(std::string_view name) const;

  std::string_view bytes_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

}  // namespace sinew
