#include "sinew/Segmentation/SelectTissues.h"

#include "sinew/Segmentation/NearestNames.h"

#include <array>
#include <charconv>
#include <functional>
#include <numeric>
#include <set>
#include <stdexcept>

namespace sinew {
namespace {

std::string nearestTissues(const Segmentation& segmentation, const std::string& wish) {
  std::vector<std::string> names;
  for (const Tissue& tissue : segmentation.tissues) names.push_back(tissue.name);
  return nearestNames(wish, names);
}

[[noreturn]] void refuse(const Segmentation& segmentation, const std::string& wish) {
  for (const Tissue& tissue : segmentation.emptyTissues)
    if (tissue.name == wish || tissue.id == wish)
      throw std::invalid_argument(segmentation.source + ": tissue '" + wish + "' has no voxel");
  throw std::invalid_argument(segmentation.source + ": no tissue '" + wish + "'; the nearest names are " +
                              nearestTissues(segmentation, wish) + "; `sinew info` lists all");
}

std::vector<int> matches(const Segmentation& segmentation, const std::string& wish) {
  std::int32_t label = 0;
  const auto parsed = std::from_chars(wish.data(), wish.data() + wish.size(), label);
  const bool isNumber = parsed.ec == std::errc() && parsed.ptr == wish.data() + wish.size();
  const std::array<std::function<bool(const Tissue&)>, 4> kinds{
      [&](const Tissue& tissue) { return tissue.name == wish; },
      [&](const Tissue& tissue) { return tissue.id == wish; },
      [&](const Tissue& tissue) { return isNumber && tissue.label == label; },
      [&](const Tissue& tissue) { return looseName(tissue.name) == looseName(wish); }};
  std::vector<int> found;
  for (const auto& matchesKind : kinds) {
    for (std::size_t t = 0; t < segmentation.tissues.size(); ++t)
      if (matchesKind(segmentation.tissues[t])) found.push_back(static_cast<int>(t));
    if (!found.empty()) break;
  }
  return found;
}

}  // namespace

std::vector<int> selectTissues(const Segmentation& segmentation, const std::vector<std::string>& wishes) {
  std::vector<int> all(segmentation.tissues.size());
  std::iota(all.begin(), all.end(), 0);
  if (wishes.empty()) return all;
  std::set<int> selected;
  for (const std::string& wish : wishes) {
    const std::vector<int> found = matches(segmentation, wish);
    if (found.empty()) refuse(segmentation, wish);
    selected.insert(found.begin(), found.end());
  }
  return {selected.begin(), selected.end()};
}

}  // namespace sinew
