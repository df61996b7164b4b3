#include "sinew/MeshIO/QuadraticMesh.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/AnalyticDistance.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace sinew {
namespace {

using Nodes = std::array<Eigen::Vector3d, 10>;
constexpr double kRadius = 10;

Nodes nodesOf(const QuadraticMesh& mesh, std::size_t t) {
  Nodes nodes;
  std::ranges::transform(mesh.tets[t], nodes.begin(), [&](std::int32_t n) { return mesh.nodes[n]; });
  return nodes;
}

/// The gradients of the ten shape functions in (r, s, t), from their formulas l (2 l - 1) and 4 l l'.
Eigen::Matrix<double, 10, 3> shapeGradients(const Eigen::Vector3d& r) {
  const Eigen::Vector4d l(1 - r.sum(), r[0], r[1], r[2]);
  Eigen::Matrix<double, 4, 3> dl;
  dl << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Eigen::Matrix<double, 10, 3> gradients;
  for (int i = 0; i < 4; ++i) gradients.row(i) = (4 * l[i] - 1) * dl.row(i);
  constexpr int kVtkEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};  // VTK's user guide
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = kVtkEdges[e];
    gradients.row(4 + e) = 4 * (l[i] * dl.row(j) + l[j] * dl.row(i));
  }
  return gradients;
}

Eigen::Matrix3d jacobian(const Nodes& nodes, const Eigen::Vector3d& r) {
  Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
  const auto gradients = shapeGradients(r);
  for (int n = 0; n < 10; ++n) j += nodes[n] * gradients.row(n);
  return j;
}

double volume(const QuadraticMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto c = jacobianCoefficients(nodesOf(mesh, t));
    sum += std::accumulate(c.begin(), c.end(), 0.0) / 20 / 6;
  }
  return sum;
}

double leastJacobian(const QuadraticMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    least = std::min(least, std::ranges::min(jacobianCoefficients(nodesOf(mesh, t))));
  return least;
}

TetMesh ball(double edgeLength) {
  GenerateTetMeshOptions options;
  options.edgeLength = edgeLength;
  options.curvature = 0;
  return generateTetMesh(test::AnalyticSphere(Eigen::Vector3d::Zero(), kRadius), options);
}

std::optional<Eigen::Vector3d> onSphere(const Eigen::Vector3d& x) { return kRadius * x.normalized(); }

/// A unit cube of 6 tets around its diagonal.
TetMesh cube() {
  TetMesh mesh;
  for (int c = 0; c < 8; ++c) mesh.nodes.emplace_back(c & 1, c >> 1 & 1, c >> 2);
  mesh.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  mesh.labels.assign(6, 1);
  return mesh;
}

Nodes randomTet(std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  const auto shifted = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x + Eigen::Vector3d(shift(random), shift(random), shift(random)));
  };
  Nodes nodes{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
              Eigen::Vector3d::UnitZ()};
  for (int e = 0; e < 6; ++e) nodes[4 + e] = (nodes[kMiddles[e][0]] + nodes[kMiddles[e][1]]) / 2;
  std::ranges::transform(nodes, nodes.begin(), shifted);
  return nodes;
}

TEST(QuadraticMesh, TablesOfMiddlesAgree) {
  for (int e = 0; e < 6; ++e) {
    EXPECT_EQ(kMiddleOf[kMiddles[e][0]][kMiddles[e][1]], 4 + e);
    EXPECT_EQ(kMiddleOf[kMiddles[e][1]][kMiddles[e][0]], 4 + e);
  }
}

TEST(QuadraticMesh, CoefficientsOfAStraightTetAreSixVolumes) {
  Nodes nodes{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 2, 3), Eigen::Vector3d(1, 4, 3),
              Eigen::Vector3d(1, 2, 8)};
  for (int e = 0; e < 6; ++e) nodes[4 + e] = (nodes[kMiddles[e][0]] + nodes[kMiddles[e][1]]) / 2;
  for (const double c : jacobianCoefficients(nodes)) EXPECT_NEAR(c, 3 * 2 * 5, 1e-12);
}

TEST(QuadraticMesh, CoefficientsGiveTheDeterminantEverywhere) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Nodes nodes = randomTet(random);
    const auto coefficients = jacobianCoefficients(nodes);
    const auto [least, most] = std::ranges::minmax(coefficients);
    for (int sample = 0; sample < 20; ++sample) {
      Eigen::Vector3d r(uniform(random), uniform(random), uniform(random));
      if (r.sum() > 1) r /= r.sum();
      const Eigen::Vector4d l(1 - r.sum(), r[0], r[1], r[2]);
      // sum over i <= j <= k of c_ijk 3!/(multiplicities) l_i l_j l_k, in the order of the coefficients
      double sum = 0;
      std::size_t place = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j)
          for (int k = j; k < 4; ++k) {
            const int ways = i == j && j == k ? 1 : i == j || j == k ? 3 : 6;
            sum += coefficients[place++] * ways * l[i] * l[j] * l[k];
          }
      const double determinant = jacobian(nodes, r).determinant();
      EXPECT_NEAR(sum, determinant, 1e-12);
      EXPECT_GE(determinant, least - 1e-12);
      EXPECT_LE(determinant, most + 1e-12);
    }
  }
}

TEST(QuadraticMesh, EveryEdgeHasOneMiddle) {
  const TetMesh mesh = test::bccBlock({4, 4, 4});
  const QuadraticMesh quadratic = quadraticMesh(mesh);
  std::vector<int> used(quadratic.nodes.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (int e = 0; e < 6; ++e) {
      const std::int32_t middle = quadratic.tets[t][4 + e];
      const auto [i, j] = kMiddles[e];
      EXPECT_EQ(quadratic.nodes[middle], (mesh.nodes[mesh.tets[t][i]] + mesh.nodes[mesh.tets[t][j]]) / 2);
      used[middle] = 1;
    }
  // V - E + F - T = 1 for a ball, and every tet has four faces, half of the inner ones
  const auto boundary = std::ssize(meshBoundary(mesh).triangles);
  const auto faces = (4 * std::ssize(mesh.tets) + boundary) / 2;
  EXPECT_EQ(std::ssize(quadratic.nodes) - std::ssize(mesh.nodes),
            std::ssize(mesh.nodes) + faces - std::ssize(mesh.tets) - 1);
  EXPECT_EQ(std::accumulate(used.begin(), used.end(), 0),
            std::ssize(quadratic.nodes) - std::ssize(mesh.nodes));
}

TEST(CurveBoundary, OfABallLiesOnTheSphere) {
  const TetMesh mesh = ball(3);
  const CurvedBoundary curved = curveBoundary(mesh, onSphere);
  EXPECT_EQ(std::ssize(curved.edges), curved.boundaryEdges);
  EXPECT_EQ(curved.boundaryEdges * 2, 3 * std::ssize(meshBoundary(mesh).triangles));
  EXPECT_EQ(curved.pulledBackEdges + curved.straightenedEdges + curved.awayEdges, 0);
  for (const CurvedEdge& edge : curved.edges) EXPECT_NEAR(edge.middle.norm(), kRadius, 1e-12);
  EXPECT_GT(leastJacobian(quadraticMesh(mesh, curved.edges)), 0);
}

TEST(CurveBoundary, WithoutASurfaceFollowsTheNormals) {
  const TetMesh mesh = ball(3);
  const CurvedBoundary curved = curveBoundary(mesh);
  EXPECT_EQ(std::ssize(curved.edges), curved.boundaryEdges);
  for (const CurvedEdge& edge : curved.edges) {
    // On a sphere the normals are exact; an edge that spans 2 theta then has its middle at R cos (1 + sin^2 /
    // 2).
    const double sine = (mesh.nodes[edge.nodes[0]] - mesh.nodes[edge.nodes[1]]).norm() / 2 / kRadius;
    const double expected = kRadius * std::sqrt(1 - sine * sine) * (1 + sine * sine / 2);
    EXPECT_NEAR(edge.middle.norm(), expected, 1e-5 * kRadius);  // nodes are that near to the sphere
    EXPECT_NEAR(edge.middle.norm(), kRadius, 0.4 * kRadius * std::pow(sine, 4) + 1e-5 * kRadius);
  }
  EXPECT_GT(leastJacobian(quadraticMesh(mesh, curved.edges)), 0);
}

TEST(CurveBoundary, VolumeConvergesFasterThanOfStraightTets) {
  const double exact = 4 * std::numbers::pi / 3 * std::pow(kRadius, 3);
  std::array<double, 2> straight{}, curved{};
  for (int refined = 0; refined < 2; ++refined) {
    const TetMesh mesh = ball(refined == 0 ? 4 : 2);
    straight[refined] = std::abs(volume(quadraticMesh(mesh)) - exact) / exact;
    curved[refined] =
        std::abs(volume(quadraticMesh(mesh, curveBoundary(mesh, onSphere).edges)) - exact) / exact;
  }
  EXPECT_LT(curved[1], straight[1] / 50);
  EXPECT_GT(straight[0] / straight[1], 3);  // order 2: a quarter
  EXPECT_LT(straight[0] / straight[1], 6);
  EXPECT_GT(curved[0] / curved[1], 10);  // order 4: a sixteenth
}

TEST(CurveBoundary, InnerEdgesStayStraight) {
  const TetMesh mesh = ball(3);
  const auto edges = curveBoundary(mesh, onSphere).edges;
  const QuadraticMesh straight = quadraticMesh(mesh), curved = quadraticMesh(mesh, edges);
  std::int64_t moved = 0;
  for (std::size_t n = 0; n < straight.nodes.size(); ++n) moved += straight.nodes[n] != curved.nodes[n];
  EXPECT_EQ(moved, std::ssize(edges));
  EXPECT_EQ(straight.tets, curved.tets);
}

/// A constant stress is in equilibrium: the integrals of an inner node's shape function's gradient add up to
/// 0.
TEST(CurveBoundary, CurvedTetsPassThePatchTest) {
  const TetMesh mesh = ball(4);
  const CurvedBoundary boundary = curveBoundary(mesh, onSphere);
  const QuadraticMesh curved = quadraticMesh(mesh, boundary.edges);
  std::vector<Eigen::Vector3d> force(curved.nodes.size(), Eigen::Vector3d::Zero());
  // Five points and weights, exact for the cubic integrand (Keast 1986).
  std::array<Eigen::Vector3d, 5> points;
  points.fill(Eigen::Vector3d::Constant(1.0 / 6));
  points[0].setConstant(0.25);
  for (int axis = 0; axis < 3; ++axis) points[2 + axis][axis] = 0.5;
  for (std::size_t t = 0; t < curved.tets.size(); ++t)
    for (int p = 0; p < 5; ++p) {
      const Eigen::Matrix3d j = jacobian(nodesOf(curved, t), points[p]);
      const double weight = (p == 0 ? -4.0 / 5 : 9.0 / 20) / 6;
      const Eigen::Matrix<double, 10, 3> gradients =
          shapeGradients(points[p]) * j.inverse() * j.determinant();
      for (int n = 0; n < 10; ++n) force[curved.tets[t][n]] += weight * gradients.row(n).transpose();
    }
  std::vector<bool> outside(curved.nodes.size(), false);
  for (const Triangle& triangle : meshBoundary(mesh).triangles)
    for (const std::int32_t node : triangle) outside[node] = true;
  const QuadraticMesh straight = quadraticMesh(mesh);
  for (std::size_t n = mesh.nodes.size(); n < outside.size(); ++n)
    outside[n] = straight.nodes[n] != curved.nodes[n];
  std::int64_t inner = 0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (outside[n]) continue;
    ++inner;
    EXPECT_LT(force[n].norm(), 1e-12 * kRadius * kRadius) << n;
  }
  EXPECT_GT(inner, 100);
}

TEST(CurveBoundary, CreasesAndFlatFacesStayAsTheyAre) {
  const CurvedBoundary curved = curveBoundary(cube());
  EXPECT_EQ(curved.boundaryEdges, 18);
  EXPECT_EQ(curved.awayEdges, 12);  // the edges of the cube
  EXPECT_TRUE(curved.edges.empty());
}

TEST(CurveBoundary, FollowsASurfaceOnlyWhereTetsStayValid) {
  // A flat tet under a dome that would push its upper faces' edges through the lower one's side.
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.05}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  const auto up = [](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
    return Eigen::Vector3d(x.x(), x.y(), x.z() < 0.01 ? x.z() + 0.1 : x.z());
  };
  const CurvedBoundary curved = curveBoundary(mesh, up);
  EXPECT_EQ(curved.pulledBackEdges + curved.straightenedEdges, 3);
  const double straight = 0.05;
  EXPECT_GE(leastJacobian(quadraticMesh(mesh, curved.edges)), 0.1 * straight - 1e-15);
  // without the rule it would be turned inside out
  std::vector<CurvedEdge> all;
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
    all.push_back({{i, j}, *up((mesh.nodes[i] + mesh.nodes[j]) / 2)});
  EXPECT_LT(leastJacobian(quadraticMesh(mesh, all)), 0);
}

TEST(CurveBoundary, ASurfaceFarAwayIsNoneOfTheEdges) {
  const TetMesh mesh = cube();
  const auto far = [](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
    return Eigen::Vector3d(x + Eigen::Vector3d(0, 0, 0.5));
  };
  EXPECT_TRUE(curveBoundary(mesh, far).edges.empty());
  EXPECT_EQ(curveBoundary(mesh, far).awayEdges, 18);
  EXPECT_EQ(curveBoundary(mesh, [](const Eigen::Vector3d&) { return std::nullopt; }).awayEdges, 18);
}

TEST(CurveBoundary, TurnedTetsKeepStraightEdges) {
  TetMesh mesh = cube();
  for (Tet& tet : mesh.tets) std::swap(tet[0], tet[1]);
  const auto out = [](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
    return Eigen::Vector3d(x + Eigen::Vector3d(0, 0, 0.01));
  };
  const CurvedBoundary curved = curveBoundary(mesh, out);
  EXPECT_TRUE(curved.edges.empty());
  EXPECT_EQ(curved.straightenedEdges, 18);
}

}  // namespace
}  // namespace sinew
