#include "Laws.h"
#include "SoundSegmentation.h"
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

bool run(std::string_view name, std::string_view bytes, const ReadSegmentationOptions& options) {
  const auto segmentation =
      readAs(name, bytes, [&](const std::filesystem::path& file) { return readSegmentation(file, options); });
  if (!segmentation) return false;
  require(!segmentation->tissues.empty(), "nothing was read");
  requireSound(*segmentation);
  requireRoundTrip(*segmentation);
  return true;
}

}  // namespace

bool runSegmentation(std::string_view bytes) {
  putVoxelsBeside();
  return run(kName, bytes, {});
}

bool runDicom(std::string_view bytes) { return run("input.dcm", bytes, {.fractionalThreshold = 0.5}); }

}  // namespace sinew::fuzz
