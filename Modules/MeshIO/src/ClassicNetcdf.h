#pragma once

#include "TextWriter.h"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sinew {

/// The values of a netCDF variable, one after the other, as big-endian bytes.
class NetcdfValues {
 public:
  explicit NetcdfValues(TextWriter& file) : file_(file) {}
  void put(std::int32_t value) { bytes(std::bit_cast<std::uint32_t>(value)); }
  void put(std::uint64_t value) { bytes(value); }
  void put(float value) { bytes(std::bit_cast<std::uint32_t>(value)); }
  void put(double value) { bytes(std::bit_cast<std::uint64_t>(value)); }
  /// Filled up with zeros, or cut.
  void put(std::string text, std::size_t width) {
    text.resize(width);
    file_ << text;
  }

 private:
  template <class Unsigned>
  void bytes(Unsigned value) {
    std::array<char, sizeof(Unsigned)> big;
    for (std::size_t i = 0; i < big.size(); ++i)
      big[i] = static_cast<char>(value >> 8 * (big.size() - 1 - i));
    file_ << std::string_view(big.data(), big.size());
  }

  TextWriter& file_;
};

enum class NetcdfType : std::int32_t { Char = 2, Int = 4, Float = 5, Double = 6 };

/// A netCDF file of the classic format with 64-bit offsets (CDF-2), which every netCDF library reads:
/// dimensions, attributes and variables that do not grow. One record dimension may be there, without records.
/// Source: "The NetCDF Classic Format Specification", Unidata.
class ClassicNetcdf {
 public:
  static constexpr std::size_t kGrows = 0;  ///< the size of the record dimension

  /// @return its number
  int addDimension(std::string name, std::size_t size);
  void addAttribute(std::string name, std::string text);
  void addAttribute(std::string name, std::int32_t value);
  void addAttribute(std::string name, float value);
  /// @param values      puts as many values of the type as the product of the dimensions says
  /// @param attribute   a text of the variable's, by its name; none where the name is empty
  void addVariable(std::string name, std::vector<int> dimensions, NetcdfType type,
                   std::function<void(NetcdfValues&)> values,
                   std::pair<std::string, std::string> attribute = {});

  /// @throws std::runtime_error saying what went wrong; a variable of 4 GiB or more does not fit
  void write(const std::filesystem::path& file) const;

 private:
  struct Dimension {
    std::string name;
    std::size_t size;
  };
  struct Attribute {
    std::string name;
    NetcdfType type;
    std::string text;
    std::uint32_t number;  ///< the bits of an int or a float
  };
  struct Variable {
    std::string name;
    std::vector<int> dimensions;
    NetcdfType type;
    std::function<void(NetcdfValues&)> values;
    std::vector<Attribute> attributes;
  };

  std::uint64_t bytesOf(const Variable& variable) const;
  std::uint64_t headerBytes() const;

  std::vector<Dimension> dimensions_;
  std::vector<Attribute> attributes_;
  std::vector<Variable> variables_;
};

}  // namespace sinew
