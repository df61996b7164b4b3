#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace sinew {

/// Name and colour of one label value.
struct LabelTableEntry {
  std::string name;
  std::array<double, 3> color{0.5, 0.5, 0.5};  ///< RGB in 0..1
  std::string terminology{};                   ///< Slicer's TerminologyEntry, empty when there is none
};

/// Label value -> name and colour.
using LabelTable = std::map<std::int32_t, LabelTableEntry>;

/// Reads a colour table: Slicer .ctbl/.txt (`id name r g b a`), Slicer .csv/.tsv
/// (`LabelValue,Name,Color_R,...`), FreeSurfer LUT (same columns as .ctbl, any white space), ITK-SNAP label
/// descriptions
/// (`IDX R G B A VIS MSH "LABEL"`), and MRtrix basic tables. The kind is told from the content.
/// @throws std::runtime_error naming the file and the line when nothing fits.
LabelTable readLabelTable(const std::filesystem::path& file);

}  // namespace sinew
