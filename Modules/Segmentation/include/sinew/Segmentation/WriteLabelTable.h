#pragma once

#include "sinew/Segmentation/LabelTable.h"
#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>

namespace sinew {

/// Whether writeLabelTable knows the ending: .ctbl, .csv, .tsv.
bool isLabelTableName(const std::filesystem::path& file);

/// The tissues of a segmentation, empty ones too, as a table. Where two tissues share a label, the first
/// one's name.
LabelTable labelTable(const Segmentation& segmentation);

/// Writes a colour table, in the form of its ending:
///   .ctbl  3D Slicer's (`id name r g b a`); a space in a name is an underscore there, and comes back as a
///   space .csv   3D Slicer's from 5.10 on (`LabelValue,Name,Color_R,...`), with the codes of the tags'
///   TerminologyEntry .tsv   BIDS's dseg.tsv (`index name color`, the colour as #rrggbb)
/// Colours are kept to 1/255. Reading it gives the same table.
/// @throws std::invalid_argument for another ending; std::runtime_error naming the file when it cannot be
/// written
void writeLabelTable(const LabelTable& table, const std::filesystem::path& file);

}  // namespace sinew
