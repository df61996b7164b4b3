#include "LabelValues.h"

#include "Text.h"

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace sinew {

namespace {

namespace fs = std::filesystem;

/// Calls `function` with a null value of the C++ type.
template <class Function>
auto withType(ValueType type, Function function) {
  switch (type) {
    case ValueType::UInt8:
      return function(std::uint8_t{});
    case ValueType::Int8:
      return function(std::int8_t{});
    case ValueType::UInt16:
      return function(std::uint16_t{});
    case ValueType::Int16:
      return function(std::int16_t{});
    case ValueType::UInt32:
      return function(std::uint32_t{});
    case ValueType::Int32:
      return function(std::int32_t{});
    case ValueType::UInt64:
      return function(std::uint64_t{});
    case ValueType::Int64:
      return function(std::int64_t{});
    case ValueType::Float32:
      return function(float{});
    case ValueType::Float64:
      break;
  }
  return function(double{});
}

template <class Value>
bool isLabel(Value value) {
  if constexpr (std::is_floating_point_v<Value>)
    return value >= Value(-2147483648.0) && value < Value(2147483648.0) && value == std::trunc(value);
  else
    return std::in_range<std::int32_t>(value);
}

template <class Value>
std::string format(Value value) {
  if constexpr (std::is_floating_point_v<Value>)
    return text::format(value);
  else
    return std::to_string(value);
}

template <class Value>
bool isFraction(Value value) {
  if constexpr (std::is_floating_point_v<Value>) return std::isfinite(value) && value != std::trunc(value);
  return false;
}

template <class Value>
[[noreturn]] void refuseValue(const fs::path& file, const ImageGeometry& geometry, Value value,
                              std::size_t voxel) {
  const auto nx = static_cast<std::size_t>(geometry.size.x()),
             ny = static_cast<std::size_t>(geometry.size.y());
  const std::string index = "(" + std::to_string(voxel % nx) + ", " + std::to_string(voxel / nx % ny) + ", " +
                            std::to_string(voxel / nx / ny) + ")";
  text::refuse(file,
               "voxel " + index + " has the value " + format(value) +
                   (isFraction(value) ? "; labels are whole numbers: if this is a scan or a probability map, "
                                        "threshold or round it first"
                                      : "; labels are whole numbers from -2147483648 to 2147483647, renumber "
                                        "them"));
}

}  // namespace

std::size_t bytesOf(ValueType type) {
  return withType(type, [](auto value) { return sizeof(value); });
}

void convertToLabels(const fs::path& file, const ImageGeometry& geometry, ValueType type,
                     const std::byte* values, std::size_t stride, std::size_t first,
                     std::span<std::int32_t> labels) {
  withType(type, [&]<class Value>(Value) {
    const auto* typed = reinterpret_cast<const Value*>(values);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Value value = typed[i * stride];
      if (!isLabel(value)) refuseValue(file, geometry, value, first + i);
      labels[i] = static_cast<std::int32_t>(value);
    }
  });
}

}  // namespace sinew
