#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Every count, for comparison as a whole.
struct Counts {
  std::int64_t edges = 0, nodes = 0, fourBoundary = 0, interiorEdges = 0, interiorFaces = 0;
  bool operator==(const Counts&) const = default;
};

Counts countsOf(const TetMesh& mesh) {
  const MeshConditions c = meshConditions(mesh);
  return {c.nonmanifoldEdges, c.nonmanifoldNodes, c.tetsWithFourBoundaryNodes,
          c.interiorEdgesBetweenBoundaryNodes, c.interiorFacesWithThreeBoundaryNodes};
}

void PrintTo(const Counts& c, std::ostream* out) {
  *out << c.edges << ' ' << c.nodes << ' ' << c.fourBoundary << ' ' << c.interiorEdges << ' '
       << c.interiorFaces;
}

/// A ball of tets around a lattice point inside a block.
TetMesh bccBall(int cubes, double radius) {
  const Vector3d centre = Vector3d::Constant(cubes / 2.0);
  return test::bccBlock(Eigen::Vector3i::Constant(cubes),
                        [=](const Vector3d& x) { return (x - centre).norm() < radius; });
}

/// The tets within `minor` of the circle of radius `major` about the z axis.
TetMesh bccTorus(double major, double minor) {
  const int half = int(major + minor) + 2, height = int(minor) + 2;
  return test::bccBlock({2 * half, 2 * half, 2 * height}, [=](const Vector3d& x) {
    const double fromCircle = std::hypot(x.x() - half, x.y() - half) - major;
    return std::hypot(fromCircle, x.z() - height) < minor;
  });
}

/// The definitions of the paper, word by word, with sets and without any cleverness.
Counts naiveCounts(const TetMesh& mesh) {
  using Nodes = std::set<std::int32_t>;
  std::map<Nodes, int> tetsAtFace;
  for (const Tet& tet : mesh.tets)
    for (const auto& [i, j, k] : kTetFaces) ++tetsAtFace[{tet[i], tet[j], tet[k]}];
  Nodes boundary;
  std::map<Nodes, std::vector<Nodes>> trianglesAtEdge;
  std::map<std::int32_t, std::vector<Nodes>> trianglesAtNode;
  Counts counts;
  for (const auto& [face, tets] : tetsAtFace) {
    if (tets != 1) continue;
    boundary.insert(face.begin(), face.end());
    for (const std::int32_t node : face) {
      Nodes edge = face;
      edge.erase(node);
      trianglesAtEdge[edge].push_back(face);
      trianglesAtNode[node].push_back(face);
    }
  }
  const auto inside = [&](const Nodes& nodes) { return std::ranges::includes(boundary, nodes); };
  for (const auto& [face, tets] : tetsAtFace) counts.interiorFaces += tets == 2 && inside(face);
  for (const auto& [edge, triangles] : trianglesAtEdge) counts.edges += triangles.size() != 2;
  std::set<Nodes> interiorEdges;
  for (const Tet& tet : mesh.tets) {
    counts.fourBoundary += inside({tet[0], tet[1], tet[2], tet[3]});
    for (const auto& [i, j] : kTetEdges)
      if (inside({tet[i], tet[j]}) && !trianglesAtEdge.contains({tet[i], tet[j]}))
        interiorEdges.insert({tet[i], tet[j]});
  }
  counts.interiorEdges = std::ssize(interiorEdges);
  for (const auto& [node, triangles] :
       trianglesAtNode) {  // one fan: every triangle reached through edges at the node
    std::set<Nodes> reached{triangles.front()};
    bool single = true;
    for (bool grew = true; grew;) {
      grew = false;
      for (const Nodes& triangle : triangles)
        for (const std::int32_t other : triangle) {
          if (other == node || reached.contains(triangle)) continue;
          for (const Nodes& neighbour : trianglesAtEdge[{node, other}])
            if (reached.contains(neighbour)) grew = reached.insert(triangle).second || grew;
        }
    }
    for (const std::int32_t other : boundary)
      if (other != node && trianglesAtEdge.contains({node, other}))
        single &= trianglesAtEdge[{node, other}].size() == 2;
    counts.nodes += !single || reached.size() != triangles.size();
  }
  return counts;
}

TEST(MeshConditions, OfOneTet) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_EQ(countsOf(mesh), (Counts{.fourBoundary = 1}));
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.boundaryComponents, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(MeshConditions, TwoTetsAtOneNodeAreABowTie) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 4, 6, 5}};
  EXPECT_EQ(countsOf(mesh), (Counts{.nodes = 1, .fourBoundary = 2}));
  EXPECT_EQ(meshTopology(mesh).components, 2);
  EXPECT_EQ(meshTopology(mesh).boundaryComponents, 2);
  EXPECT_EQ(meshTopology(mesh).eulerCharacteristic, 3);
}

TEST(MeshConditions, TwoTetsAtOneEdgeShareABadEdgeAndItsEnds) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.tets = {{0, 1, 3, 2}, {0, 1, 5, 4}};
  EXPECT_EQ(countsOf(mesh), (Counts{.edges = 1, .nodes = 2, .fourBoundary = 2}));
  EXPECT_EQ(meshTopology(mesh).components, 2);
}

TEST(MeshConditions, TwoTetsAtOneFaceHaveOneInteriorFaceOfBoundaryNodes) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {4, 1, 3, 2}};
  EXPECT_EQ(countsOf(mesh), (Counts{.fourBoundary = 2, .interiorFaces = 1}));
  EXPECT_EQ(meshTopology(mesh).components, 1);
}

TEST(MeshConditions, ARingOfTetsHasOneInteriorEdgeBetweenBoundaryNodes) {
  const TetMesh ring = test::bccBlock({1, 1, 2});  // four tets around the edge of two cube centres
  EXPECT_EQ(countsOf(ring), (Counts{.fourBoundary = 4, .interiorEdges = 1, .interiorFaces = 4}));
}

TEST(MeshConditions, ALargeBallHasNone) {
  // The star of every node of the lattice is convex: a full star has interior node and boundary ring only.
  const TetMesh star = test::bccBlock({3, 3, 3}, [](const Vector3d& x) {
    return (x - Vector3d::Constant(1.5)).lpNorm<1>() < 0.8;  // the 24 tets at the middle cube's centre
  });
  ASSERT_EQ(star.tets.size(), 24u);
  EXPECT_TRUE(meshConditions(star).good());
}

TEST(MeshConditions, AgreeWithTheDefinitionsOnRandomParts) {
  std::mt19937 random(17);
  for (const std::uint32_t percent : {20, 50, 80, 97}) {
    const TetMesh mesh = test::bccBlock({4, 4, 4}, [&](const Vector3d&) { return random() % 100 < percent; });
    EXPECT_EQ(countsOf(mesh), naiveCounts(mesh)) << percent << " % kept, seed 17";
  }
}

TEST(MeshConditions, DoNotDependOnTheOrderOfTetsAndNodes) {
  std::mt19937 random(23);
  TetMesh mesh = test::bccBlock({4, 4, 4}, [&](const Vector3d&) { return random() % 100 < 60; });
  const Counts before = countsOf(mesh);
  const MeshTopology topologyBefore = meshTopology(mesh);
  std::vector<std::int32_t> renumbered(mesh.nodes.size());
  for (std::size_t i = 0; i < renumbered.size(); ++i) renumbered[i] = std::int32_t(i);
  std::shuffle(renumbered.begin(), renumbered.end(), random);
  for (Tet& tet : mesh.tets) {
    for (std::int32_t& node : tet) node = renumbered[node];
    std::swap(tet[0], tet[1]);
    std::swap(tet[2], tet[3]);
  }
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
  EXPECT_EQ(countsOf(mesh), before);
  EXPECT_EQ(meshTopology(mesh).components, topologyBefore.components);
  EXPECT_EQ(meshTopology(mesh).boundaryComponents, topologyBefore.boundaryComponents);
  EXPECT_EQ(meshTopology(mesh).eulerCharacteristic, topologyBefore.eulerCharacteristic);
}

TEST(BoundaryTriangles, FaceOutwardInTheOrderOfTheTets) {
  const TetMesh ball = bccBall(6, 2.3);
  const std::vector<Triangle> triangles = meshBoundary(ball).triangles;
  // Divergence theorem: sum over triangles of det(a, b, c) / 6 is the volume, positive for outward triangles.
  double volume = 0;
  for (const auto& [a, b, c] : triangles) volume += ball.nodes[a].cross(ball.nodes[b]).dot(ball.nodes[c]) / 6;
  EXPECT_NEAR(volume, static_cast<double>(ball.tets.size()) / 12, 1e-10);

  std::vector<Triangle> expected;
  for (const Tet& tet : ball.tets)
    for (const auto& [i, j, k] : kTetFaces)
      if (std::ranges::find(triangles, Triangle{tet[i], tet[j], tet[k]}) != triangles.end())
        expected.push_back({tet[i], tet[j], tet[k]});
  EXPECT_EQ(triangles, expected);
}

TEST(MeshTopology, OfBallTorusAndShell) {
  const MeshTopology ball = meshTopology(bccBall(8, 3.2));
  EXPECT_EQ(ball.components, 1);
  EXPECT_EQ(ball.boundaryComponents, 1);
  EXPECT_EQ(ball.eulerCharacteristic, 2);

  const TetMesh solidTorus = bccTorus(5, 2);
  ASSERT_EQ(meshConditions(solidTorus).nonmanifoldNodes, 0);
  const MeshTopology torus = meshTopology(solidTorus);
  EXPECT_EQ(torus.components, 1);
  EXPECT_EQ(torus.boundaryComponents, 1);
  EXPECT_EQ(torus.eulerCharacteristic, 0);

  const MeshTopology shell = meshTopology(test::bccBlock({7, 7, 7}, [](const Vector3d& x) {
    return (x - Vector3d::Constant(3.5)).lpNorm<Eigen::Infinity>() > 1.2;
  }));
  EXPECT_EQ(shell.components, 1);
  EXPECT_EQ(shell.boundaryComponents, 2);
  EXPECT_EQ(shell.eulerCharacteristic, 4);
}

TEST(MeshConditions, CountsFacesOfManyTets) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  mesh.labels = {1, 1};
  EXPECT_EQ(meshConditions(mesh).facesOfManyTets, 0);
  mesh.tets.push_back({0, 1, 2, 5});
  EXPECT_EQ(meshConditions(mesh).facesOfManyTets, 1);
  EXPECT_FALSE(meshConditions(mesh).good());
}

TEST(MeshTopology, OfNothing) {
  const MeshTopology topology = meshTopology({});
  EXPECT_EQ(topology.components, 0);
  EXPECT_EQ(topology.boundaryComponents, 0);
  EXPECT_EQ(topology.eulerCharacteristic, 0);
  EXPECT_TRUE(meshConditions({}).good());
  EXPECT_TRUE(meshBoundary({}).triangles.empty());
}

}  // namespace
}  // namespace sinew
