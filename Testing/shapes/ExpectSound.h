#pragma once

#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"

#include <gtest/gtest.h>

namespace sinew::test {

constexpr double kMaxAspectRatio = 3.5;  // the goal is 3.0 and [30, 130]; these are what no shape may pass
constexpr double kMinDihedralDeg = 25, kMaxDihedralDeg = 140;
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
