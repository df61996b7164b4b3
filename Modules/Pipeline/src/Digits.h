#pragma once

#include <string>

namespace sinew {

/// A number for a message, with three digits.
std::string threeDigits(double value);

}  // namespace sinew
