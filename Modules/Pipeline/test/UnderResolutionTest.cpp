#include "UnderResolution.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

/// A ball, meshed as it should be.
TissueReport soundReport() {
  TissueReport report;
  report.name = "ball";
  report.edgeLength = 0.9;
  report.topology.components = report.levelSetComponents = 1;
  report.topology.eulerCharacteristic = report.levelSetEuler = 2;
  report.fidelity.volume = 96;
  report.fidelity.levelSetVolume = report.fidelity.labelVolume = 100;
  return report;
}

TEST(UnderResolution, AWholeMeshIsNotWarnedOf) { EXPECT_EQ(underResolution(soundReport()), ""); }

TEST(UnderResolution, EverySignIsToldWithHalfTheEdgeLength) {
  TissueReport report = soundReport();
  report.fidelity.volume = 94;
  EXPECT_EQ(underResolution(report), "under-resolved: volume 6 % too small; try --size 'ball=0.45mm'");
  report.fidelity.volume = 106;
  EXPECT_EQ(underResolution(report), "under-resolved: volume 6 % too large; try --size 'ball=0.45mm'");
  report = soundReport();
  report.topology.eulerCharacteristic = 0;
  EXPECT_EQ(underResolution(report),
            "under-resolved: Euler characteristic 0 instead of 2; try --size 'ball=0.45mm'");
  report = soundReport();
  report.topology.components = 2;
  EXPECT_EQ(underResolution(report), "under-resolved: 2 components instead of 1; try --size 'ball=0.45mm'");
}

TEST(UnderResolution, TheWidestDifferenceIsTold) {
  TissueReport report = soundReport();
  report.topologyDifferences = {{.change = TopologyChange::BridgeLost,
                                 .place = {1, -2.04, 30.06},
                                 .width = 0.5,
                                 .reason = "the cubes there are too large"}};
  EXPECT_EQ(underResolution(report), "") << "the counts agree";
  report.topology.components = 2;
  EXPECT_EQ(underResolution(report),
            "under-resolved: 2 components instead of 1, at its widest a bridge lost, 0.5 mm across, at (1.0, "
            "-2.0, 30.1) mm, the cubes there are too large; try --size 'ball=0.45mm'");
}

TEST(UnderResolution, LostPiecesGetThreeCubesAlong) {
  TissueReport report = soundReport();
  report.lost = {2, 2 * 0.27};  // pieces of 0.65^3 mm^3
  EXPECT_EQ(underResolution(report),
            "under-resolved: 2 pieces of 0.54 mm^3 in all lost; try --size 'ball=0.21mm'");
  report.lost = {1, 64};
  EXPECT_EQ(underResolution(report),
            "under-resolved: 1 piece of 64 mm^3 in all lost; try --size 'ball=0.45mm'");
}

TEST(UnderResolution, TheOptionCanBePastedIntoAShell) {
  EXPECT_EQ(sizeOption("vastus lateralis", 0.4567), "--size 'vastus lateralis=0.45mm'");
  EXPECT_EQ(sizeOption("Baker's cyst", 12.9), "--size 'Baker'\\''s cyst=12mm'");
  EXPECT_EQ(sizeOption("a", 0.3), "--size 'a=0.3mm'") << "rounding of 0.3 itself";
}

}  // namespace
}  // namespace sinew
