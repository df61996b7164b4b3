#include "Background.h"
#include "KeptSet.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sinew {
namespace {

using test::Background;
using test::backgroundOf;

std::vector<std::int32_t> someEnveloped(const KeptSet& set, std::size_t count, std::mt19937& random) {
  std::vector<std::int32_t> all, some;
  for (std::size_t n = 0; n < set.enveloped().size(); ++n)
    if (set.enveloped()[n] != 0) all.push_back(static_cast<std::int32_t>(n));
  for (std::size_t k = 0; k < count && !all.empty(); ++k) some.push_back(all[random() % all.size()]);
  std::ranges::sort(some);
  some.erase(std::unique(some.begin(), some.end()), some.end());
  return some;
}

/// What the kept set says about its boundary, told from the mesh.
void expectBoundaryOf(const KeptSet& set, const Background& b) {
  std::vector<std::int32_t> latticeNodes;
  const TetMesh mesh = extractMesh(b.mesh, set.keep(), 1, &latticeNodes);
  for (std::size_t n = 0; n < latticeNodes.size(); ++n)
    ASSERT_EQ(set.isBoundary(latticeNodes[n]), mesh.kinds[n] == NodeKind::Boundary);
}

TEST(KeptSet, ReleasingKeepsTheConditionsAndOnlyShrinks) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    const Background b = backgroundOf(shape, 2);
    KeptSet set(b.mesh, b.stars, selectCandidate(b.mesh, b.stars).enveloped);
    std::mt19937 random(seed);
    for (int round = 0; round < 6; ++round) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round) + ", " + shape.name());
      std::vector<std::uint8_t> expected = set.enveloped();
      const std::vector<std::int32_t> wanted = someEnveloped(set, 4, random);
      const std::vector<std::int32_t> released = releaseNodes(set, wanted);
      EXPECT_TRUE(std::ranges::includes(released, wanted));
      for (const std::int32_t n : released) {
        EXPECT_EQ(expected[n], 1);
        expected[n] = 0;
      }
      EXPECT_EQ(set.enveloped(), expected);
      EXPECT_TRUE(meshConditions(extractMesh(b.mesh, set.keep(), 1)).good());
      expectBoundaryOf(set, b);
    }
  }
}

TEST(KeptSet, EnvelopingPutsBackWhatWasReleased) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Background b = backgroundOf(test::randomShape(seed), 2);
    KeptSet set(b.mesh, b.stars, selectCandidate(b.mesh, b.stars).enveloped);
    const std::vector<std::uint8_t> enveloped = set.enveloped(), keep = set.keep();
    std::mt19937 random(seed);
    const std::vector<std::int32_t> released = releaseNodes(set, someEnveloped(set, 5, random));
    EXPECT_NE(set.keep(), keep);
    for (const std::int32_t n : released) set.envelope(n);
    EXPECT_EQ(set.enveloped(), enveloped);
    EXPECT_EQ(set.keep(), keep);
    expectBoundaryOf(set, b);
  }
}

std::vector<std::int32_t> boundaryNodes(const KeptSet& set) {
  std::vector<std::int32_t> nodes;
  for (std::size_t n = 0; n < set.enveloped().size(); ++n)
    if (set.isBoundary(static_cast<std::int32_t>(n))) nodes.push_back(static_cast<std::int32_t>(n));
  return nodes;
}

TEST(KeptSet, TakingANodeInKeepsTheConditionsOrChangesNothing) {
  constexpr std::size_t kMost = 8;
  int taken = 0, refused = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    const Background b = backgroundOf(test::randomShape(seed), 2);
    KeptSet set(b.mesh, b.stars, selectCandidate(b.mesh, b.stars).enveloped);
    std::mt19937 random(seed);
    for (int round = 0; round < 6; ++round) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
      const std::vector<std::int32_t> boundary = boundaryNodes(set);
      const std::int32_t node = boundary[random() % boundary.size()];
      std::vector<std::uint8_t> expected = set.enveloped();
      const std::vector<std::int32_t> enveloped = envelopeNode(set, node, kMost);
      enveloped.empty() ? ++refused : ++taken;
      EXPECT_LE(enveloped.size(), kMost);
      EXPECT_EQ(std::ranges::binary_search(enveloped, node), !enveloped.empty());
      for (const std::int32_t n : enveloped) {
        EXPECT_EQ(expected[n], 0);
        expected[n] = 1;
      }
      EXPECT_EQ(set.enveloped(), expected);
      EXPECT_TRUE(meshConditions(extractMesh(b.mesh, set.keep(), 1)).good());
      expectBoundaryOf(set, b);
    }
  }
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0) << "else the limit was not tried";
}

TEST(KeptSet, ReleasingMendsWhatWasNotEnveloped) {
  int mended = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Background b = backgroundOf(test::randomShape(seed), 2);
    KeptSet set(b.mesh, b.stars, selectCandidate(b.mesh, b.stars, {.maxPasses = 0}).enveloped);
    const bool wasGood = meshConditions(extractMesh(b.mesh, set.keep(), 1)).good();
    const std::vector<std::int32_t> released = releaseViolations(set, boundaryNodes(set));
    EXPECT_EQ(released.empty(), wasGood);
    EXPECT_TRUE(meshConditions(extractMesh(b.mesh, set.keep(), 1)).good());
    mended += !wasGood;
  }
  EXPECT_GT(mended, 0);
}

TEST(KeptSet, ReleasingNothingChangesNothing) {
  const Background b = backgroundOf(test::AnalyticSphere(Eigen::Vector3d::Zero(), 4), 1);
  KeptSet set(b.mesh, b.stars, selectCandidate(b.mesh, b.stars).enveloped);
  const std::vector<std::uint8_t> keep = set.keep();
  EXPECT_TRUE(releaseNodes(set, {}).empty());
  EXPECT_EQ(set.keep(), keep);
}

}  // namespace
}  // namespace sinew
