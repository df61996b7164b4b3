#include "Sampling.h"
#include "Shapes.h"
#include "SimplePoint.h"
#include "sinew/LevelSet/FieldPieces.h"

#include <gtest/gtest.h>

#include <random>

namespace sinew {
namespace {

/// Euler characteristic V - E + F - C of the union of closed cubes around the inside samples, which hang
/// together by corners.
int eulerCharacteristic(const DenseField& phi) {
  const Eigen::Vector3i& size = phi.size;
  const auto inside = [&](const Eigen::Array3i& at) {
    return (at >= 0).all() && (at < size.array()).all() && phi(at[0], at[1], at[2]) < 0;
  };
  // Half steps: along an axis, even places are corners between two cubes, odd ones the insides of cubes.
  const auto cube = [](int place, int side) { return place % 2 == 0 ? place / 2 - side : place / 2; };
  int euler = 0;
  for (int z = 0; z <= 2 * size.z(); ++z)
    for (int y = 0; y <= 2 * size.y(); ++y)
      for (int x = 0; x <= 2 * size.x(); ++x) {
        bool covered = false;
        for (int c = 0; c < 8 && !covered; ++c)
          covered = inside({cube(x, c & 1), cube(y, c >> 1 & 1), cube(z, c >> 2)});
        const int dimension = x % 2 + y % 2 + z % 2;
        if (covered) euler += dimension % 2 == 0 ? 1 : -1;
      }
  return euler;
}

struct Topology {
  std::size_t pieces, hollows;
  int euler;
  bool operator==(const Topology&) const = default;
};

Topology topologyOf(const DenseField& phi) {
  return {fieldPieces(phi, true, Connectivity::Corners).samples.size(),
          fieldPieces(phi, false, Connectivity::Faces).samples.size(), eulerCharacteristic(phi)};
}

DenseField fieldOf(Neighbourhood neighbourhood) {
  DenseField field({5, 5, 5}, 1);  // one layer of outside around, so that the outside hangs together there
  for (int bit = 0; bit < 27; ++bit)
    if (neighbourhood >> bit & 1) field(bit % 3 + 1, bit / 3 % 3 + 1, bit / 9 + 1) = -1;
  return field;
}

TEST(SimplePoint, ChangesNeitherPiecesNorHolesNorHollows) {
  std::mt19937 random(7);
  int simple = 0, notSimple = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Neighbourhood n = random() & random() & 0x7ffffff;
    if (trial % 2 == 0) n = (n | random()) & 0x7ffffff;
    constexpr Neighbourhood kMiddle = 1U << 13;
    const bool same = topologyOf(fieldOf(n | kMiddle)) == topologyOf(fieldOf(n & ~kMiddle));
    EXPECT_EQ(isSimplePoint(n), isSimplePoint(n ^ kMiddle)) << "the middle itself does not count";
    if (isSimplePoint(n)) {
      EXPECT_TRUE(same) << "neighbourhood " << n << ", trial " << trial;
    }
    isSimplePoint(n) ? ++simple : ++notSimple;
  }
  EXPECT_GT(simple, 100);
  EXPECT_GT(notSimple, 100);
}

TEST(SimplePoint, ByHand) {
  constexpr auto bit = [](int i, int j, int k) { return 1U << ((i + 1) + 3 * (j + 1) + 9 * (k + 1)); };
  EXPECT_FALSE(isSimplePoint(0)) << "a piece of its own";
  EXPECT_FALSE(isSimplePoint(0x7ffffff)) << "a hollow of its own";
  EXPECT_TRUE(isSimplePoint(bit(1, 0, 0))) << "the end of a thread";
  EXPECT_FALSE(isSimplePoint(bit(1, 0, 0) | bit(-1, 0, 0))) << "the middle of a thread";
  EXPECT_TRUE(isSimplePoint(bit(1, 0, 0) | bit(1, 1, 1)));
  Neighbourhood plane = 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) plane |= bit(i, j, 0);
  EXPECT_FALSE(isSimplePoint(plane)) << "would pierce a sheet";
}

TEST(SimplePoint, HeldSamplesKeepTheTopology) {
  // A thread between two balls, a thin shell and a speck: all of which the wanted field has lost.
  const auto thread = [](const Eigen::Vector3d& x) {
    return std::max(x.tail<2>().norm() - 1.2, std::abs(x.x()) - 10);
  };
  const auto shell = [](const Eigen::Vector3d& x) {
    return std::abs((x - Eigen::Vector3d(0, 0, 13)).norm() - 4) - 0.8;
  };
  const auto balls = [](const Eigen::Vector3d& x) {
    return std::min(test::ball({-10, 0, 0}, 5)(x), test::ball({10, 0, 0}, 5)(x));
  };
  const DenseLevelSet kept = test::levelSetOf([&](const Eigen::Vector3d& x) {
    return std::min({thread(x), shell(x), balls(x), test::ball({0, 13, 0}, 1.1)(x)});
  });
  const Topology topology = topologyOf(kept.phi);
  ASSERT_EQ(topology.pieces, 3U);
  DenseLevelSet wanted = test::levelSetOf([&](const Eigen::Vector3d& x) {
    return std::min(balls(x) + 1.5, test::ball({0, 0, 13}, 5)(x));
  });
  ASSERT_NE(topologyOf(wanted.phi), topology);
  const DenseField without = wanted.phi;
  EXPECT_GT(holdTopology(insideOf(kept.phi), wanted.phi, 0.1F), 0);
  EXPECT_EQ(topologyOf(wanted.phi), topology);
  EXPECT_EQ(wanted.phi(10, 20, 20), without(10, 20, 20)) << "where nothing hinders, all is as wanted";
}

}  // namespace
}  // namespace sinew
