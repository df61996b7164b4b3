#include "Sampling.h"
#include "sinew/LevelSet/SmallPieces.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3i;

/// Two diagonal voxels, a lone voxel, and a block.
DenseMask pieces() {
  return test::maskOf({12, 12, 12}, [](int i, int j, int k) {
    const bool pair = (i == 1 && j == 1 && k == 1) || (i == 2 && j == 2 && k == 2);
    const bool block = i >= 6 && i < 9 && j >= 6 && j < 9 && k >= 6 && k < 9;
    return pair || block || (i == 10 && j == 1 && k == 1);
  });
}

TEST(SmallPieces, WhatIsLostComesBackAndWhatIsThereStays) {
  DenseField field(Vector3i(12, 12, 12), 0.3F);
  field(7, 7, 7) = -0.1F;  // the block has shrunk to its middle, the others are gone
  EXPECT_EQ(restoreSmallPieces(field, pieces(), -0.5F), 2);
  for (const Vector3i& at : {Vector3i(1, 1, 1), Vector3i(2, 2, 2), Vector3i(10, 1, 1)})
    EXPECT_EQ(field(at.x(), at.y(), at.z()), -0.5F);
  EXPECT_EQ(field(7, 7, 7), -0.1F);
  EXPECT_EQ(field(6, 6, 6), 0.3F);
  EXPECT_EQ(restoreSmallPieces(field, pieces(), -0.5F), 0) << "nothing is lost any more";
}

TEST(SmallPieces, LargePiecesAreLeftAlone) {
  DenseField field(Vector3i(12, 12, 12), 0.3F);
  EXPECT_EQ(restoreSmallPieces(field, pieces(), -0.5F, 26), 2) << "the block has 27 voxels";
  EXPECT_EQ(restoreSmallPieces(field, pieces(), -0.5F, 27), 1);
}

TEST(SmallPieces, RefusesSizesThatDifferAndAnInsideThatIsOutside) {
  DenseField field(Vector3i(12, 12, 11), 0.3F);
  EXPECT_THROW(restoreSmallPieces(field, pieces(), -0.5F), std::invalid_argument);
  field = DenseField(Vector3i(12, 12, 12));
  EXPECT_THROW(restoreSmallPieces(field, pieces(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
