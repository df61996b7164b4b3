#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What is wrong with a .ply file, in a few words.
struct PlyDamaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };
enum class PlyKind { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyKind kind;
  std::optional<PlyKind> listCount;  ///< of the number of items; empty: no list
};

/// A table of the file.
struct PlyElement {
  std::string name;
  std::uint64_t rows;  ///< as claimed
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;
  std::size_t size;  ///< bytes before the first number
};

/// @throws PlyDamaged when the bytes do not begin with a header.
PlyHeader parsePlyHeader(std::string_view bytes);

}  // namespace sinew
