#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace sinew {

/// One bar per line, the longest of 40 columns; what is not nothing has a mark at least.
struct BarChart {
  struct Bar {
    std::string name;
    std::int64_t count;
  };
  std::string title;
  std::vector<Bar> bars;

  /// Empty bars before the first and after the last full one are left out.
  void print(std::ostream& stream) const;
};

}  // namespace sinew
