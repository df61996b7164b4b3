#include "SoundSegmentation.h"

#include "Laws.h"

namespace sinew::fuzz {
namespace {

void requireSoundTissue(const Segmentation& segmentation, const Tissue& tissue) {
  require(tissue.layer >= 0 && tissue.layer < static_cast<int>(segmentation.layers.size()),
          "a tissue lies on no layer");
  require(tissue.label != 0, "a tissue is the background");
  require(tissue.voxels > 0 && !tissue.box.empty(), "a tissue of the table has no voxels");
  require((tissue.box.lower.array() >= 0).all() &&
              (tissue.box.upper.array() <= segmentation.geometry.size.array()).all(),
          "a tissue reaches out of the volume");
}

}  // namespace

void requireSound(const Segmentation& segmentation) {
  const ImageGeometry& geometry = segmentation.geometry;
  require((geometry.size.array() > 0).all() && geometry.spacing.allFinite() &&
              (geometry.spacing.array() > 0).all() && geometry.direction.allFinite() &&
              geometry.origin.allFinite(),
          "the geometry is unsound");
  require(!segmentation.layers.empty(), "there is no layer");
  for (const auto& layer : segmentation.layers)
    require(static_cast<std::int64_t>(layer.size()) == geometry.voxelCount(), "a layer has not all voxels");
  for (const Tissue& tissue : segmentation.tissues) requireSoundTissue(segmentation, tissue);
}

}  // namespace sinew::fuzz
