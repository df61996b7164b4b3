#include "Digits.h"

#include <cstdio>

namespace sinew {

std::string threeDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace sinew
