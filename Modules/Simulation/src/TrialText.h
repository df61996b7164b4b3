#pragma once

#include <Eigen/Core>

#include <array>
#include <charconv>
#include <string>

namespace sinew {

/// The same in every locale; "-0" is "0".
inline std::string fixedText(double value, int digits) {
  std::array<char, 400> text;  // the largest double has 309 digits
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::fixed, digits).ptr;
  std::string result(text.begin(), end);
  if (result.starts_with('-') && result.find_first_of("123456789") == std::string::npos) result.erase(0, 1);
  return result;
}

/// "(1.0, 2.0, 3.0) mm"
inline std::string placeText(const Eigen::Vector3d& place) {
  std::string text = "(";
  text += fixedText(place.x(), 1) + ", ";
  text += fixedText(place.y(), 1) + ", ";
  return text + fixedText(place.z(), 1) + ") mm";
}

}  // namespace sinew
