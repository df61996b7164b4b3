#include "sinew/Segmentation/WriteLabelMap.h"

#include "Text.h"
#include "VoxelFile.h"
#include "sinew/Segmentation/WriteLabelTable.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace sinew {

namespace {

namespace fs = std::filesystem;

void writePlainNrrd(const Segmentation& segmentation, const fs::path& file) {
  writeNrrd(segmentation, file, {});
}

struct LabelMapFormat {
  std::string_view ending;  ///< lower case
  void (*write)(const Segmentation&, const fs::path&);
};

constexpr std::array kLabelMapFormats{LabelMapFormat{".nrrd", writePlainNrrd},
                                      LabelMapFormat{".nii", writeNifti},
                                      LabelMapFormat{".nii.gz", writeNifti},
                                      LabelMapFormat{".mha", writeMeta}, LabelMapFormat{".mhd", writeMeta}};

const LabelMapFormat* labelMapFormatOf(const fs::path& file) {
  const std::string name = text::lower(file.filename().string());
  if (name.ends_with(".seg.nrrd")) return nullptr;
  const auto found = std::ranges::find_if(
      kLabelMapFormats, [&](const LabelMapFormat& format) { return name.ends_with(format.ending); });
  return found == kLabelMapFormats.end() ? nullptr : &*found;
}

std::string knownEndings() {
  std::string result;
  for (const LabelMapFormat& format : kLabelMapFormats)
    result.append(result.empty() ? "" : ", ").append(format.ending);
  return result;
}

}  // namespace

bool isLabelMapName(const fs::path& file) { return labelMapFormatOf(file) != nullptr; }

LabelMapReport writeLabelMap(const Segmentation& segmentation, const fs::path& file,
                             const MergeLayersOptions& options) {
  const LabelMapFormat* format = labelMapFormatOf(file);
  if (!format)
    throw std::invalid_argument("writeLabelMap: " + file.string() + " ends in none of " + knownEndings());
  requireWritable(segmentation);
  std::optional<MergedLayers> merged;
  if (segmentation.layers.size() > 1) merged = mergeLayers(segmentation, options);
  const Segmentation& flat = merged ? merged->segmentation : segmentation;
  format->write(flat, file);
  LabelMapReport report{.table = labelTable(flat), .changes = {}};
  if (merged) {
    report.changes = std::move(merged->changes);
    report.contestedVoxels = merged->contestedVoxels;
  }
  return report;
}

}  // namespace sinew
