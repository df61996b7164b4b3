#include "Terminology.h"

#include "Text.h"

#include <algorithm>

namespace sinew::terminology {

namespace {

constexpr std::size_t kParts = 7, kRegionList = 4, kCodeCells = 3;
constexpr std::array<std::size_t, 5> kCodeParts{1, 2, 3, 5,
                                                6};  ///< of the parts; the others are names of lists
constexpr std::array<const char*, 5> kCodeNames{"Category", "Type", "TypeModifier", "Region",
                                                "RegionModifier"};
constexpr std::array<const char*, kCodeCells> kCellNames{"CodingScheme", "CodeValue", "CodeMeaning"};

std::string withoutSeparators(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '~' || c == '^' || c == '|'; }, '/');
  return text;
}

}  // namespace

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const std::string code : kCodeNames)
      for (const std::string cell : kCellNames) result.push_back(code + "_" + cell);
    return result;
  }();
  return names;
}

std::vector<std::string> cells(std::string_view entry) {
  const auto parts = text::split(entry, '~');
  std::vector<std::string> result;
  for (const std::size_t part : kCodeParts) {
    const auto code = part < parts.size() ? text::split(parts[part], '^') : std::vector<std::string_view>{};
    for (std::size_t c = 0; c < kCodeCells; ++c) result.emplace_back(c < code.size() ? code[c] : "");
  }
  return result;
}

std::string entry(const std::vector<std::string>& cells, const std::string& list,
                  const std::string& regionList) {
  if (std::ranges::all_of(cells, &std::string::empty)) return {};
  std::array<std::string, kParts> parts;
  parts[0] = list;
  parts[kRegionList] = regionList;
  for (std::size_t code = 0; code < kCodeParts.size(); ++code)
    for (std::size_t c = 0; c < kCodeCells; ++c)
      parts[kCodeParts[code]].append(c ? "^" : "").append(withoutSeparators(cells[code * kCodeCells + c]));
  std::string result = parts[0];
  for (std::size_t part = 1; part < kParts; ++part) result.append("~").append(parts[part]);
  return result;
}

std::string withoutLists(std::string_view text) { return entry(cells(text)); }

}  // namespace sinew::terminology
