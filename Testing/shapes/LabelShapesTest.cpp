#include "ExpectSound.h"
#include "RandomLabels.h"
#include "Seeds.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

constexpr unsigned kLabelShapes = 132;

/// A way to mesh.
struct LabelMeshing {
  const char* name;
  Length edge, minEdge;
  double curvature;
  Length tolerance;
  bool preserveVolume;
  double maxVolumeError;
};
const std::array<LabelMeshing, 5> kLabelMeshings{
    {{"as by default", Length::voxels(2), 0, 1, 0, false, 0.03},
     {"fine where thin", Length::voxels(2), Length::voxels(0.5), 1, 0, false, 0.03},
     {"one size", Length::voxels(1.2), 0, 0, 0, false, 0.08},
     {"within a tolerance", Length::voxels(3), 0, 0, Length::voxels(0.1), false, 0.05},
     {"volume kept", Length::voxels(2), 0, 1, 0, true, 0.001}}};

MeshTissuesOptions optionsOf(const LabelMeshing& meshing) {
  MeshTissuesOptions options;
  options.edgeLength = meshing.edge;
  options.minEdgeLength = meshing.minEdge;
  options.curvature = meshing.curvature;
  options.tolerance = meshing.tolerance;
  options.preserveVolume = meshing.preserveVolume;
  return options;
}

TEST(LabelShapes, EveryMeshIsSound) {
  const test::TempFolder folder;
  const std::vector<unsigned> seeds = test::seeds(kLabelShapes);
  EXPECT_FALSE(seeds.empty());
  for (const unsigned seed : seeds) {
    const auto [drawing, segmentation] = test::RandomScan(seed).make();
    const LabelMeshing& meshing = kLabelMeshings[seed % kLabelMeshings.size()];
    SCOPED_TRACE(test::repeatWith(seed, std::string(drawing.name) + ", " + meshing.name));
    ASSERT_EQ(segmentation.tissues.size(), 1u);
    const TissueReport report = meshTissues(segmentation, {0}, folder.path(), optionsOf(meshing)).front();
    EXPECT_EQ(report.status, TissueStatus::Meshed) << report.message;
    test::expectSound(report.quality, report.conditions, report.fidelity.maxBoundaryPhi / report.edgeLength);
    EXPECT_NEAR(report.fidelity.volume / report.fidelity.levelSetVolume, 1, meshing.maxVolumeError);
    if (drawing.simple) {
      EXPECT_EQ(report.topology.components, report.levelSetComponents);
      EXPECT_EQ(report.topology.eulerCharacteristic, report.levelSetEuler);
    }
  }
}

}  // namespace
}  // namespace sinew
