#include "sinew/Segmentation/LabelTable.h"

#include "Terminology.h"
#include "Text.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

namespace {

using Words = std::vector<std::string_view>;
using Entry = std::optional<std::pair<std::int32_t, LabelTableEntry>>;

struct Line {
  std::size_t number;  ///< from 1
  std::string_view text;
};

constexpr std::uintmax_t kLargestTable = 64 << 20;  // bytes; a table of all 16-bit labels has 4 MB

std::string readTableFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) text::refuse(file, "there is no such colour table; check the path");
  if (!std::filesystem::is_regular_file(status))
    text::refuse(file, "is a folder or a device; name the colour table's file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) text::refuse(file, "cannot be opened for reading; check its permissions");
  std::string content;
  if (std::filesystem::file_size(file) <= kLargestTable) content.assign(std::istreambuf_iterator(stream), {});
  if (content.find('\0') != std::string::npos || std::filesystem::file_size(file) > kLargestTable)
    text::refuse(file, "is not a colour table; that has one text line `label name red green blue` per label");
  return content;
}

/// Text lines that are neither blank nor comment; comments go to `comments`.
std::vector<Line> contentLines(std::string_view content, std::string& comments) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  std::vector<Line> lines;
  std::size_t number = 0;
  for (const std::string_view raw : text::split(content, '\n')) {
    const std::string_view line = text::trim(raw);
    ++number;
    if (line.starts_with('#') || line.starts_with("//"))
      comments.append(line).append("\n");
    else if (!line.empty())
      lines.push_back({number, line});
  }
  return lines;
}

/// Red, green, blue in 0..255 to 0..1.
std::optional<std::array<double, 3>> byteColor(std::span<const std::string_view> rgb) {
  std::array<double, 3> color;
  for (int c = 0; c < 3; ++c) {
    const auto value = text::number<double>(rgb[c]);
    if (!value || !(*value >= 0 && *value <= 255)) return std::nullopt;
    color[c] = *value / 255;
  }
  return color;
}

bool isNumber(std::string_view word) { return text::number<double>(word).has_value(); }

std::string joined(std::span<const std::string_view> words) {
  std::string result;
  for (const std::string_view word : words) (result += result.empty() ? "" : " ") += word;
  return result;
}

/// `label name [r g b [a]]`, the columns of Slicer, FreeSurfer and MRtrix basic; or MRtrix's own
/// `label short-name name r g b a`. The name may hold spaces: colours are counted from the end.
Entry parseColumns(std::string_view line) {
  const Words words = text::words(line);
  if (words.size() < 2) return std::nullopt;
  const auto label = text::number<std::int32_t>(words.front());
  if (!label) return std::nullopt;

  std::size_t numbers = 0;
  while (numbers < 4 && numbers + 2 < words.size() && isNumber(words[words.size() - 1 - numbers])) ++numbers;
  if (numbers < 3) {
    // A name alone: a number at its end belongs to it, as in `7 vertebra 7`.
    return std::pair(*label, LabelTableEntry{.name = joined(std::span(words).subspan(1))});
  }
  const auto name = std::span(words).subspan(1, words.size() - 1 - numbers);
  const auto color = byteColor(std::span(words).last(numbers));
  if (!color) return std::nullopt;
  return std::pair(*label, LabelTableEntry{.name = joined(name), .color = *color});
}

/// MRtrix's own table: `label short-name name r g b a`, no spaces in names.
Entry parseMrtrix(std::string_view line) {
  const Words words = text::words(line);
  if (words.size() != 7 || isNumber(words[2])) return std::nullopt;
  const auto label = text::number<std::int32_t>(words[0]);
  const auto color = byteColor(std::span(words).subspan(3));
  if (!label || !color) return std::nullopt;
  return std::pair(*label, LabelTableEntry{.name = std::string(words[2]), .color = *color});
}

/// `IDX R G B A VIS MSH "LABEL"`
Entry parseItkSnap(std::string_view line) {
  const auto open = line.find('"'), close = line.rfind('"');
  if (open == std::string_view::npos || open == close) return std::nullopt;
  const Words words = text::words(line.substr(0, open));
  if (words.size() != 7) return std::nullopt;
  const auto label = text::number<std::int32_t>(words[0]);
  const auto color = byteColor(std::span(words).subspan(1));
  if (!label || !color) return std::nullopt;
  return std::pair(
      *label, LabelTableEntry{.name = std::string(line.substr(open + 1, close - open - 1)), .color = *color});
}

LabelTable parseLines(const std::filesystem::path& file, std::span<const Line> lines,
                      Entry (*parse)(std::string_view), std::string_view columns) {
  LabelTable table;
  for (const Line& line : lines) {
    Entry entry = parse(line.text);
    if (!entry)
      text::refuse(file, "line " + std::to_string(line.number) + " `" + text::printable(line.text) +
                             "` does not fit the colour table's columns (" + std::string(columns) +
                             "; colours 0 to 255); correct it or put # before it");
    entry->second.name = text::toUtf8(entry->second.name);
    table.insert_or_assign(entry->first, std::move(entry->second));
  }
  return table;
}

/// Cells of a line of comma or tab separated values; a cell in quotes may hold separators and doubled quotes,
/// and keeps its white space.
std::vector<std::string> cells(std::string_view line, char separator) {
  std::vector<std::string> result(1);
  bool quoted = false, keep = false;
  const auto endCell = [&] {
    if (!keep) result.back() = std::string(text::trim(result.back()));
    keep = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      result.back() += line[++i];
    } else if (line[i] == '"') {
      keep = true;
      quoted = !quoted;
    } else if (line[i] == separator && !quoted) {
      endCell();
      result.emplace_back();
    } else {
      result.back() += line[i];
    }
  }
  endCell();
  return result;
}

/// Where a table with a header line keeps what we need; Slicer's names first, then those of BIDS and others.
struct CellColumns {
  std::optional<std::size_t> label, name, red, green, blue, hex;
  std::vector<std::optional<std::size_t>> codes;  ///< as terminology::columns()
};

std::optional<std::size_t> findColumn(const std::vector<std::string>& header,
                                      std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(header, name, [](const auto& cell) { return text::lower(cell); });
    if (found != header.end()) return found - header.begin();
  }
  return std::nullopt;
}

CellColumns cellColumns(const std::vector<std::string>& header) {
  std::vector<std::optional<std::size_t>> codes;
  for (const std::string& name : terminology::columns())
    codes.push_back(findColumn(header, {text::lower(name)}));
  return {.label = findColumn(header, {"labelvalue", "index", "label", "id", "value"}),
          .name = findColumn(header, {"name"}),
          .red = findColumn(header, {"color_r", "r", "red"}),
          .green = findColumn(header, {"color_g", "g", "green"}),
          .blue = findColumn(header, {"color_b", "b", "blue"}),
          .hex = findColumn(header, {"color"}),
          .codes = std::move(codes)};
}

/// `#rrggbb`
std::optional<std::array<double, 3>> hexColor(std::string_view cell) {
  if (cell.size() != 7 || cell[0] != '#') return std::nullopt;
  std::array<double, 3> color;
  for (int c = 0; c < 3; ++c) {
    unsigned value = 0;
    const char* first = cell.data() + 1 + 2 * c;
    if (std::from_chars(first, first + 2, value, 16).ptr != first + 2) return std::nullopt;
    color[c] = value / 255.0;
  }
  return color;
}

Entry parseCells(const std::vector<std::string>& row, const CellColumns& columns) {
  const auto cell = [&](std::optional<std::size_t> column) -> std::string_view {
    return column && *column < row.size() ? std::string_view(row[*column]) : std::string_view();
  };
  const auto label = text::number<std::int32_t>(cell(columns.label));
  if (!label) return std::nullopt;
  LabelTableEntry entry{.name = text::toUtf8(cell(columns.name))};
  if (columns.hex && entry.name == "n/a") entry.name.clear();  // how BIDS writes that there is none
  std::vector<std::string> codes;
  for (const auto& column : columns.codes) codes.push_back(text::toUtf8(cell(column)));
  entry.terminology = terminology::entry(codes);
  if (columns.red && columns.green && columns.blue) {
    const std::array rgb{cell(columns.red), cell(columns.green), cell(columns.blue)};
    const auto color = byteColor(rgb);
    if (!color) return std::nullopt;
    entry.color = *color;
  } else if (const auto color = hexColor(cell(columns.hex))) {
    entry.color = *color;
  }
  return std::pair(*label, entry);
}

LabelTable parseCellTable(const std::filesystem::path& file, std::span<const Line> lines, char separator,
                          const CellColumns& columns) {
  LabelTable table;
  for (const Line& line : lines.subspan(1)) {
    Entry entry = parseCells(cells(line.text, separator), columns);
    if (!entry)
      text::refuse(file, "line " + std::to_string(line.number) + " `" + text::printable(line.text) +
                             "` has no whole label value or no colour from 0 to 255; correct it");
    table.insert_or_assign(entry->first, std::move(entry->second));
  }
  return table;
}

/// Slicer writes a space in a name as an underscore. Its files are told by their first comment, or their
/// name.
bool isSlicerTable(const std::filesystem::path& file, std::string_view comments) {
  return text::lower(comments).find("color table file") != std::string::npos ||
         text::lower(file.extension().string()) == ".ctbl";
}

/// `# label 12 is named left_kidney`: what writeLabelTable says of names that the underscores would change.
void applyNamesInComments(LabelTable& table, std::string_view comments) {
  constexpr std::string_view mark = "# label ", verb = " is named ";
  for (std::string_view line : text::split(comments, '\n')) {
    if (!line.starts_with(mark)) continue;
    line.remove_prefix(mark.size());
    const auto end = line.find(verb);
    if (end == std::string_view::npos) continue;
    const auto label = text::number<std::int32_t>(line.substr(0, end));
    const auto entry = label ? table.find(*label) : table.end();
    // A separator that no line holds: the name is the only cell.
    if (entry != table.end())
      entry->second.name = text::toUtf8(cells(line.substr(end + verb.size()), '\n').front());
  }
}

void underscoresToSpaces(LabelTable& table) {
  for (auto& [label, entry] : table) {
    std::ranges::replace(entry.name, '_', ' ');
    entry.name = text::trim(entry.name);
  }
}

}  // namespace

LabelTable readLabelTable(const std::filesystem::path& file) {
  const std::string content = readTableFile(file);
  std::string comments;
  const std::vector<Line> lines = contentLines(content, comments);
  if (lines.empty())
    text::refuse(file, "holds no label; a colour table has one line `label name red green blue` per label");

  const std::string_view first = lines.front().text;
  for (const char separator : {',', '\t'}) {
    const CellColumns columns = cellColumns(cells(first, separator));
    if (columns.label && columns.name) return parseCellTable(file, lines, separator, columns);
  }
  if (parseItkSnap(first)) return parseLines(file, lines, parseItkSnap, "IDX R G B A VIS MSH \"LABEL\"");
  if (std::ranges::all_of(lines, [](const Line& line) { return parseMrtrix(line.text).has_value(); }))
    return parseLines(file, lines, parseMrtrix, "label short-name name r g b a");
  LabelTable table = parseLines(file, lines, parseColumns, "label name r g b a");
  if (isSlicerTable(file, comments)) {
    underscoresToSpaces(table);
    applyNamesInComments(table, comments);
  }
  return table;
}

}  // namespace sinew
