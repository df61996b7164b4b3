#pragma once

#include <Eigen/Core>

#include <charconv>
#include <string>

namespace sinew {

/// A number with so many digits at most, the same in every locale.
inline std::string toText(double value, int digits = 4) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
}

/// The shortest text that gives the same number back.
inline std::string exactText(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

inline std::string toText(const Eigen::Vector3d& x) {
  return toText(x.x()) + ", " + toText(x.y()) + ", " + toText(x.z());
}

}  // namespace sinew
