#include "Laws.h"
#include "Targets.h"
#include "sinew/Segmentation/LabelTable.h"

#include <algorithm>

namespace sinew::fuzz {

bool runLabelTable(std::string_view bytes) {
  const auto table = readAs("input.txt", bytes, &readLabelTable);
  if (!table) return false;
  for (const auto& [label, entry] : *table) {
    require(std::ranges::all_of(entry.color, [](double c) { return c >= 0 && c <= 1; }),
            "a colour is out of range");
    require(entry.name.find('\n') == entry.name.npos, "a name has several lines");
  }
  return true;
}

}  // namespace sinew::fuzz
