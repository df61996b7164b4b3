#pragma once

#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"

#include <gtest/gtest.h>

namespace sinew::test {

// The goal for a tissue is 3.0 and [30, 130]; the worst of 4,000 shapes beyond those of the tests had 3.87
// and 20.8 degrees, at a bridge and a gyroid refined below the spacing of their level sets.
constexpr double kMaxAspectRatio = 4;
constexpr double kMinDihedralDeg = 20, kMaxDihedralDeg = 145;
constexpr double kMaxBoundaryPhi = 1e-5;  // edge lengths; the mesher snaps to half of it

/// What every mesh must keep, whatever its shape.
/// @param boundaryPhi  largest |phi| at a boundary node, edge lengths
inline void expectSound(const MeshQuality& quality, const MeshConditions& conditions, double boundaryPhi) {
  EXPECT_GT(quality.tets, 0);
  EXPECT_EQ(quality.inverted, 0);
  EXPECT_LE(quality.maxAspectRatio, kMaxAspectRatio);
  EXPECT_GE(quality.minDihedralDeg, kMinDihedralDeg);
  EXPECT_LE(quality.maxDihedralDeg, kMaxDihedralDeg);
  EXPECT_EQ(conditions.facesOfManyTets, 0);
  EXPECT_EQ(conditions.nonmanifoldEdges, 0);
  EXPECT_EQ(conditions.nonmanifoldNodes, 0);
  EXPECT_EQ(conditions.tetsWithFourBoundaryNodes, 0);
  EXPECT_EQ(conditions.interiorEdgesBetweenBoundaryNodes, 0);
  EXPECT_EQ(conditions.interiorFacesWithThreeBoundaryNodes, 0);
  EXPECT_LE(boundaryPhi, kMaxBoundaryPhi);
}

}  // namespace sinew::test
