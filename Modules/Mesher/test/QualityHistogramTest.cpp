#include "sinew/Mesher/QualityHistogram.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <gtest/gtest.h>

#include <numeric>

namespace sinew {
namespace {

TEST(QualityHistogram, OfTheLatticeIsTwoAnglesAndOneAspectRatio) {
  TetMesh mesh = test::bccBlock({4, 4, 4});
  // Away from the ends of the bins, at which rounding would decide: 60 and 90 degrees become others.
  for (Eigen::Vector3d& x : mesh.nodes) x.z() *= 0.99;
  const QualityHistogram histogram = qualityHistogram(mesh);
  const auto tets = static_cast<std::int64_t>(mesh.tets.size());
  const auto sum = [&](std::size_t first, std::size_t last) {
    return std::accumulate(histogram.dihedrals.begin() + first, histogram.dihedrals.begin() + last,
                           std::int64_t{0});
  };
  // A BCC tet has four angles of 60 degrees and two of 90.
  EXPECT_EQ(sum(5, 7), 4 * tets);
  EXPECT_EQ(sum(8, 10), 2 * tets);
  EXPECT_EQ(sum(0, kDihedralBins), 6 * tets);
  EXPECT_EQ(histogram.aspectRatios[1], tets) << "about sqrt 2, in [1.25, 1.5)";
}

TEST(QualityHistogram, FlatTetsAreInTheLastBins) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.tets = {{0, 1, 3, 2}};
  const QualityHistogram histogram = qualityHistogram(mesh);
  EXPECT_EQ(histogram.aspectRatios.back(), 1);
  EXPECT_EQ(histogram.dihedrals.front(), 4) << "along the sides of the square";
  EXPECT_EQ(histogram.dihedrals.back(), 2) << "along its diagonals";
}

TEST(QualityHistogram, OfNothingIsEmpty) {
  const QualityHistogram histogram = qualityHistogram({});
  EXPECT_EQ(histogram.dihedrals, decltype(histogram.dihedrals){});
  EXPECT_EQ(histogram.aspectRatios, decltype(histogram.aspectRatios){});
}

}  // namespace
}  // namespace sinew
