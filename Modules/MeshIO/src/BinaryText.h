#pragma once

#include <bit>
#include <string_view>
#include <type_traits>

namespace sinew {

static_assert(std::endian::native == std::endian::little, "as the numbers of the files");

/// The bytes of a number as a file holds them.
template <class Number>
requires std::is_trivially_copyable_v<Number> std::string_view bytesOf(const Number& number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace sinew
