#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"

namespace sinew {

LevelSet levelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                            const LevelSetFromLabelsOptions& options, LevelSetFromLabelsReport* report) {
  return levelSetFromField(denseLevelSetFromLabels(segmentation, tissue, options, report));
}

}  // namespace sinew
