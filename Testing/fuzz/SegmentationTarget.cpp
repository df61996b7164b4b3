#include "Laws.h"
#include "Targets.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"

namespace sinew::fuzz {
namespace {

/// The readers go by the content; only the NIfTI library asks for its own name.
constexpr std::string_view kName = "input.nii.gz";

/// What detached headers name, `data file: voxels.raw`: 4 x 3 x 2 voxels.
void putVoxelsBeside() {
  static const bool once = [] {
    test::writeBytes(folder() / "voxels.raw",
                     {0, 1, 1, 0, 2, 2, 0, 0, 1, 1, 0, 0, 2, 2, 0, 0, 0, 1, 1, 0, 2, 2, 0, 0});
    return true;
  }();
  static_cast<void>(once);
}

void requireSoundTissue(const Segmentation& segmentation, const Tissue& tissue) {
  require(tissue.layer >= 0 && tissue.layer < static_cast<int>(segmentation.layers.size()),
          "a tissue lies on no layer");
  require(tissue.label != 0, "a tissue is the background");
  require(tissue.voxels > 0 && !tissue.box.empty(), "a tissue of the table has no voxels");
  require((tissue.box.lower.array() >= 0).all() &&
              (tissue.box.upper.array() <= segmentation.geometry.size.array()).all(),
          "a tissue reaches out of the volume");
}

void requireSound(const Segmentation& segmentation) {
  const ImageGeometry& geometry = segmentation.geometry;
  require(!segmentation.layers.empty() && !segmentation.tissues.empty(), "nothing was read");
  require((geometry.size.array() > 0).all() && geometry.spacing.allFinite() &&
              (geometry.spacing.array() > 0).all() && geometry.direction.allFinite() &&
              geometry.origin.allFinite(),
          "the geometry is unsound");
  for (const auto& layer : segmentation.layers)
    require(static_cast<std::int64_t>(layer.size()) == geometry.voxelCount(), "a layer has not all voxels");
  for (const Tissue& tissue : segmentation.tissues) requireSoundTissue(segmentation, tissue);
}

/// What was read can be written, and reads back as it was.
void requireRoundTrip(const Segmentation& segmentation) {
  const std::filesystem::path file = folder() / "again.seg.nrrd";
  writeSegmentation(segmentation, file);
  const Segmentation again = readSegmentation(file);
  require(again.layers == segmentation.layers, "voxels change when they are written");
  require(again.tissues.size() == segmentation.tissues.size() &&
              again.emptyTissues.size() == segmentation.emptyTissues.size(),
          "tissues come or go when they are written");
  for (std::size_t t = 0; t < again.tissues.size(); ++t) {
    const Tissue &before = segmentation.tissues[t], &after = again.tissues[t];
    require(after.label == before.label && after.layer == before.layer && after.voxels == before.voxels &&
                after.color == before.color,
            "tissue `" + before.name + "` changes when it is written");
    require(after.name == before.name, "tissue `" + before.name + "` is renamed to `" + after.name + "`");
  }
}

}  // namespace

bool runSegmentation(std::string_view bytes) {
  putVoxelsBeside();
  const auto segmentation =
      readAs(kName, bytes, [](const std::filesystem::path& file) { return readSegmentation(file); });
  if (!segmentation) return false;
  requireSound(*segmentation);
  requireRoundTrip(*segmentation);
  return true;
}

}  // namespace sinew::fuzz
