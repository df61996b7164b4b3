#include "sinew/Segmentation/WriteLabelTable.h"

#include "Terminology.h"
#include "Text.h"
#include "VoxelFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace sinew {

namespace {

namespace fs = std::filesystem;

std::array<int, 3> bytesOf(const std::array<double, 3>& color) {
  std::array<int, 3> result;
  for (int c = 0; c < 3; ++c) result[c] = static_cast<int>(std::lround(255 * std::clamp(color[c], 0.0, 1.0)));
  return result;
}

std::string joined(const std::array<int, 3>& color, std::string_view separator) {
  std::string result = std::to_string(color[0]);
  for (int c = 1; c < 3; ++c) result.append(separator).append(std::to_string(color[c]));
  return result;
}

std::string hex(const std::array<int, 3>& color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result = "#";
  for (const int c : color) (result += digits[c / 16]) += digits[c % 16];
  return result;
}

/// A line of a table cannot hold another one.
std::string oneLine(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return std::string_view("\n\r\v\f").find(c) != std::string_view::npos; }, ' ');
  return text;
}

/// In quotes where it must be.
std::string cell(const std::string& text, char separator) {
  const std::string line = oneLine(text);
  const bool plain = line.find_first_of(std::string("\"") + separator) == std::string::npos &&
                     text::trim(line).size() == line.size();
  if (plain) return line;
  std::string result = "\"";
  for (const char c : line) result.append(c == '"' ? 2 : 1, c);
  return result + "\"";
}

/// Slicer's parsers refuse a table with other labels.
void requireSlicerLabels(const LabelTable& table, const fs::path& file) {
  constexpr std::int32_t most = 1'000'000;
  for (const auto& [label, entry] : table)
    if (label < 0 || label > most)
      text::refuse(file, "3D Slicer's tables hold labels from 0 to " + std::to_string(most) + ", `" +
                             text::printable(entry.name) + "` has " + std::to_string(label) +
                             "; renumber it or write a .tsv table");
}

/// The underscore rule of .ctbl: what stands for a name without spaces.
std::string underscored(const std::string& name) {
  if (name.empty()) return "_";
  std::string result = name;
  std::ranges::replace_if(
      result, [](char c) { return c == ' ' || c == '\t'; }, '_');
  return result;
}

/// Names that the rule loses are told in a comment, which readLabelTable understands.
std::string ctbl(const LabelTable& table, const fs::path& file) {
  requireSlicerLabels(table, file);
  std::string result = "# Color table file\n# ";  // without its name, which may be a temporary one
  result.append(std::to_string(table.size())).append(" values\n");
  for (const auto& [label, entry] : table) {
    const std::string name = oneLine(entry.name), written = underscored(name);
    std::string read = written == "_" ? "" : written;
    std::ranges::replace(read, '_', ' ');
    if (text::trim(read) != name)
      result += "# label " + std::to_string(label) + " is named " + cell(name, ' ') + "\n";
    result += std::to_string(label) + " " + written + " " + joined(bytesOf(entry.color), " ") + " 255\n";
  }
  return result;
}

std::string csv(const LabelTable& table, const fs::path& file) {
  requireSlicerLabels(table, file);
  std::string result = "LabelValue,Name,Color_R,Color_G,Color_B,Color_A";
  for (const std::string& column : terminology::columns()) result.append(",").append(column);
  for (const auto& [label, entry] : table) {
    result.append("\n").append(std::to_string(label)).append(",").append(cell(entry.name, ','));
    result.append(",").append(joined(bytesOf(entry.color), ",")).append(",255");
    for (const std::string& value : terminology::cells(entry.terminology))
      result.append(",").append(cell(value, ','));
  }
  return result + "\n";
}

std::string bids(const LabelTable& table, const fs::path&) {
  std::string result = "index\tname\tcolor\n";
  for (const auto& [label, entry] : table)
    result += std::to_string(label) + "\t" + (entry.name.empty() ? "n/a" : cell(entry.name, '\t')) + "\t" +
              hex(bytesOf(entry.color)) + "\n";
  return result;
}

struct TableFormat {
  std::string_view ending;  ///< lower case
  std::string (*format)(const LabelTable&, const fs::path&);
};

constexpr std::array kTableFormats{TableFormat{".ctbl", ctbl}, TableFormat{".csv", csv},
                                   TableFormat{".tsv", bids}};

const TableFormat* tableFormatOf(const fs::path& file) {
  const auto found =
      std::ranges::find(kTableFormats, text::lower(file.extension().string()), &TableFormat::ending);
  return found == kTableFormats.end() ? nullptr : &*found;
}

}  // namespace

bool isLabelTableName(const fs::path& file) { return tableFormatOf(file) != nullptr; }

LabelTable labelTable(const Segmentation& segmentation) {
  LabelTable table;
  for (const auto* tissues : {&segmentation.tissues, &segmentation.emptyTissues})
    for (const Tissue& tissue : *tissues) {
      const auto codes = tissue.tags.find(std::string(terminology::kTag));
      table.try_emplace(tissue.label,
                        LabelTableEntry{.name = tissue.name,
                                        .color = tissue.color,
                                        .terminology = codes == tissue.tags.end()
                                                           ? std::string()
                                                           : terminology::withoutLists(codes->second)});
    }
  return table;
}

void writeLabelTable(const LabelTable& table, const fs::path& file) {
  const TableFormat* format = tableFormatOf(file);
  if (!format)
    throw std::invalid_argument("writeLabelTable: " + file.string() + " ends in none of .ctbl, .csv, .tsv");
  const std::string content = format->format(table, file);
  writeFile(file, [&](std::ostream& out) { out << content; });
}

}  // namespace sinew
