#include "Background.h"
#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace sinew {
namespace {

using Eigen::Vector3d;

using test::Background;
using test::backgroundOf;

/// Whether the kept tets are exactly those with an enveloped node.
bool keepsTheStarsOfEnvelopedNodes(const LatticeMesh& mesh, const Candidate& candidate) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const bool enveloped =
        std::ranges::any_of(mesh.tets[t], [&](std::int32_t v) { return candidate.enveloped[v] != 0; });
    if (enveloped != (candidate.keep[t] != 0)) return false;
  }
  return true;
}

void expectWithinLatticeBounds(const TetMesh& mesh) {
  constexpr double rounding = 1e-9;  // [7]: every tet is a leaf, not moved yet
  const MeshQuality q = meshQuality(mesh);
  EXPECT_LE(q.maxAspectRatio, std::sqrt(10.0) + rounding);
  EXPECT_GE(q.minDihedralDeg, 30 - rounding);
  EXPECT_LE(q.maxDihedralDeg, 116.5650511770781 + rounding);
  EXPECT_EQ(q.inverted, 0);
}

constexpr unsigned kShapes = 72;

TEST(Candidate, OfRandomShapesObeysTheConditions) {
  for (unsigned seed = 0; seed < kShapes; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + shape.name());
    const Background b = backgroundOf(shape, seed % 2 == 0 ? 1.5 : 2.0);
    const Candidate candidate = selectCandidate(b.mesh, b.stars);
    const TetMesh mesh = extractMesh(b.mesh, candidate.keep, 1);
    EXPECT_GT(mesh.tets.size(), 0u);
    EXPECT_EQ(candidate.violations, 0);
    EXPECT_TRUE(meshConditions(mesh).good());
    EXPECT_TRUE(keepsTheStarsOfEnvelopedNodes(b.mesh, candidate));
    expectWithinLatticeBounds(mesh);
  }
}

TEST(Candidate, HasTheTopologyOfSphereAndTorus) {
  const auto topologyOf = [](const SignedDistance& phi) {
    const Background b = backgroundOf(phi, 1);
    return meshTopology(extractMesh(b.mesh, selectCandidate(b.mesh, b.stars).keep, 1));
  };
  const MeshTopology ball = topologyOf(test::AnalyticSphere({0.1, 0.2, 0.3}, 5));
  EXPECT_EQ(ball.components, 1);
  EXPECT_EQ(ball.boundaryComponents, 1);
  EXPECT_EQ(ball.eulerCharacteristic, 2);
  const MeshTopology ring = topologyOf(test::AnalyticTorus({0.1, 0.2, 0.3}, 6, 2));
  EXPECT_EQ(ring.components, 1);
  EXPECT_EQ(ring.boundaryComponents, 1);
  EXPECT_EQ(ring.eulerCharacteristic, 0);
}

TEST(Candidate, WithoutRepairIsTheEnvelopeOfNodesWellInside) {
  const Background b = backgroundOf(test::AnalyticTorus({0, 0, 0}, 5, 1.6), 1);
  for (const double fraction : {0.1, 0.25, 0.5}) {
    const Candidate candidate =
        selectCandidate(b.mesh, b.stars, {.minInsideFraction = fraction, .maxPasses = 0});
    std::vector<std::uint8_t> expected(b.mesh.phi.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
      bool deep = b.mesh.phi[n] < 0;
      for (const std::int32_t t : b.stars.of(static_cast<std::int32_t>(n)))
        for (const std::int32_t v : b.mesh.tets[t]) {
          // Where linear interpolation puts the surface on the edge, from n: past the fraction, or nowhere.
          const double crossing = b.mesh.phi[v] <= 0 ? 1 : -b.mesh.phi[n] / (b.mesh.phi[v] - b.mesh.phi[n]);
          deep = deep && crossing >= fraction;
        }
      expected[n] = deep;
    }
    EXPECT_EQ(candidate.enveloped, expected) << fraction;
    EXPECT_EQ(candidate.passes, 0);
    EXPECT_EQ(candidate.added, 0);
  }
}

/// Ten shapes whose envelopes break the conditions: the repair has work to do.
TEST(Candidate, RepairOnlyAddsAndSaysWhatIsLeftAtItsCap) {
  std::int64_t added = 0, violations = 0;
  for (unsigned seed = 2; seed < 62; seed += 6) {  // gyroid pieces
    const Background b = backgroundOf(test::randomShape(seed), 2);
    const Candidate bare = selectCandidate(b.mesh, b.stars, {.maxPasses = 0});
    const Candidate repaired = selectCandidate(b.mesh, b.stars);
    violations += bare.violations;
    added += repaired.added;
    EXPECT_EQ(bare.violations == 0, meshConditions(extractMesh(b.mesh, bare.keep, 1)).good())
        << "seed " << seed;
    EXPECT_EQ(repaired.added,
              std::ranges::count(repaired.enveloped, 1) - std::ranges::count(bare.enveloped, 1));
    for (std::size_t n = 0; n < bare.enveloped.size(); ++n)
      EXPECT_LE(bare.enveloped[n], repaired.enveloped[n]);
  }
  EXPECT_GT(violations, 0);
  EXPECT_GT(added, 0);
}

/// The tets on either side of the inner faces of a mesh.
std::vector<std::pair<Tet, Tet>> neighbours(const std::vector<Tet>& tets) {
  std::map<Triangle, Tet> open;
  std::vector<std::pair<Tet, Tet>> pairs;
  for (const Tet& tet : tets)
    for (const auto& [i, j, k] : kTetFaces) {
      Triangle face{tet[i], tet[j], tet[k]};
      std::ranges::sort(face);
      const auto [it, first] = open.try_emplace(face, tet);
      if (!first) pairs.emplace_back(it->second, tet);
    }
  return pairs;
}

std::int32_t apex(const Tet& tet, const Tet& neighbour) {
  return *std::ranges::find_if(
      tet, [&](std::int32_t v) { return std::ranges::find(neighbour, v) == neighbour.end(); });
}

TEST(Candidate, SeesEveryViolationWhereTwoStarsMeet) {
  Background b = backgroundOf(test::AnalyticTorus({0, 0, 0}, 6, 2.5), 1);
  const std::vector<double> phi = b.mesh.phi;
  auto pairs = neighbours(b.mesh.tets);
  std::shuffle(pairs.begin(), pairs.end(), std::mt19937(61));
  int tried = 0, bad = 0;
  for (const auto& [first, second] : pairs) {
    const std::int32_t p = apex(first, second), q = apex(second, first);
    if (phi[p] > 0 || phi[q] > 0) continue;  // near the end of the mesh
    if (++tried > 100) break;
    std::ranges::fill(b.mesh.phi, 1.0);
    b.mesh.phi[p] = b.mesh.phi[q] = -1;
    const Candidate bare = selectCandidate(b.mesh, b.stars, {.maxPasses = 0});
    ASSERT_EQ(std::ranges::count(bare.enveloped, 1), 2);
    const bool good = meshConditions(extractMesh(b.mesh, bare.keep, 1)).good();
    bad += !good;
    EXPECT_EQ(bare.violations == 0, good) << "seed 61, pair " << tried;
    const Candidate repaired = selectCandidate(b.mesh, b.stars);
    EXPECT_EQ(repaired.violations, 0);
    EXPECT_TRUE(meshConditions(extractMesh(b.mesh, repaired.keep, 1)).good());
  }
  EXPECT_GT(bad, 0);
}

/// Two stars, around p above and q below the triangle abc, that share this one face, and what encloses them.
LatticeMesh twoStarsAtOneFace() {
  LatticeMesh mesh;
  const auto ring = [&](double radius, double turn) {
    for (int k = 0; k < 3; ++k) {
      const double angle = (2 * k + turn) * std::numbers::pi / 3;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  };
  ring(1, 0);  // 0..2: a, b, c
  ring(2, 1);  // 3..5: outside of ab, bc, ca
  for (const double z : {0.5, 1.2, 3.0, -0.5, -1.2, -3.0}) mesh.positions.emplace_back(0, 0, z);
  for (const std::int32_t side : {6, 9}) {
    const std::int32_t star = side, tip = side + 1, far = side + 2;
    mesh.tets.push_back({star, 0, 1, 2});
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t next = (k + 1) % 3;
      mesh.tets.push_back({star, k, next, tip});
      mesh.tets.push_back({k, next, tip, 3 + k});
      mesh.tets.push_back({next, tip, 3 + k, 3 + next});
      mesh.tets.push_back({far, tip, 3 + k, 3 + next});
    }
  }
  mesh.phi.assign(mesh.positions.size(), 1.0);
  mesh.phi[6] = mesh.phi[9] = -1;
  return mesh;
}

TEST(Candidate, SeesAnInnerFaceWithThreeBoundaryNodesAndNothingElseWrong) {
  const LatticeMesh mesh = twoStarsAtOneFace();
  const NodeStars stars = nodeStars(mesh.positions.size(), mesh.tets);
  const Candidate bare = selectCandidate(mesh, stars, {.maxPasses = 0});
  const MeshConditions found = meshConditions(extractMesh(mesh, bare.keep, 1));
  EXPECT_EQ(found.interiorFacesWithThreeBoundaryNodes, 1);
  EXPECT_EQ(found.nonmanifoldEdges + found.nonmanifoldNodes + found.interiorEdgesBetweenBoundaryNodes, 0);
  EXPECT_GT(bare.violations, 0);
  const Candidate repaired = selectCandidate(mesh, stars);
  EXPECT_EQ(repaired.violations, 0);
  EXPECT_TRUE(meshConditions(extractMesh(mesh, repaired.keep, 1)).good());
}

TEST(Candidate, OfNothingIsEmpty) {
  const Background b = backgroundOf(test::AnalyticSphere(Vector3d::Zero(), 0.1), 2);
  const Candidate candidate = selectCandidate(b.mesh, b.stars);
  EXPECT_EQ(std::ranges::count(candidate.keep, 1), 0);
  EXPECT_TRUE(extractMesh(b.mesh, candidate.keep, 1).tets.empty());
}

TEST(ExtractMesh, NamesTheLatticeNodesAndMarksTheBoundary) {
  const Background b = backgroundOf(test::AnalyticTorus({0, 0, 0}, 5, 2), 1);
  const Candidate candidate = selectCandidate(b.mesh, b.stars);
  std::vector<std::int32_t> latticeNodes{7, 7, 7};  // to be overwritten
  const TetMesh mesh = extractMesh(b.mesh, candidate.keep, 42, &latticeNodes);
  ASSERT_EQ(latticeNodes.size(), mesh.nodes.size());
  ASSERT_EQ(mesh.kinds.size(), mesh.nodes.size());
  EXPECT_TRUE(std::ranges::is_sorted(latticeNodes));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    EXPECT_EQ(mesh.nodes[n], b.mesh.positions[latticeNodes[n]]);
  EXPECT_EQ(mesh.labels, std::vector<std::int32_t>(mesh.tets.size(), 42));
  std::vector<NodeKind> kinds(mesh.nodes.size(), NodeKind::Interior);
  for (const Triangle& triangle : meshBoundary(mesh).triangles)
    for (const std::int32_t v : triangle) kinds[v] = NodeKind::Boundary;
  EXPECT_EQ(mesh.kinds, kinds);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < b.mesh.tets.size(); ++t) {
    if (!candidate.keep[t]) continue;
    for (int v = 0; v < 4; ++v) EXPECT_EQ(latticeNodes[mesh.tets[kept][v]], b.mesh.tets[t][v]);
    ++kept;
  }
  EXPECT_EQ(kept, mesh.tets.size());
}

}  // namespace
}  // namespace sinew
