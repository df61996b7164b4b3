#pragma once

#include <cstdlib>
#include <string>
#include <vector>

namespace sinew::test {

/// The seeds of a test of `count` shapes: all of them, or every SINEW_SHAPE_STRIDE-th where the build is
/// slow. The environment variable SINEW_SHAPES names others, to repeat a failure or to look for more: `17` or
/// `1000-1999`.
inline std::vector<unsigned> seeds(unsigned count) {
  unsigned first = 0, last = count - 1, stride = SINEW_SHAPE_STRIDE;
  if (const char* chosen = std::getenv("SINEW_SHAPES")) {
    const std::string range = chosen;
    const auto dash = range.find('-');
    first = static_cast<unsigned>(std::stoul(range));
    last = dash == range.npos ? first : static_cast<unsigned>(std::stoul(range.substr(dash + 1)));
    stride = 1;
  }
  std::vector<unsigned> all;
  for (unsigned seed = first; seed <= last; seed += stride) all.push_back(seed);
  return all;
}

inline std::string repeatWith(unsigned seed, const std::string& shape) {
  return shape + "; to repeat it: SINEW_SHAPES=" + std::to_string(seed);
}

}  // namespace sinew::test
