#include "sinew/Elasticity/Equilibrium.h"
#include "sinew/Elasticity/Material.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kInner = 1, kOuter = 2;        // mm
constexpr double kYoung = 100, kPoisson = 0.3;  // kPa
constexpr double kPressure = 0.01;              // kPa: strains of 1e-4, where every law is linear

/// From the cube's shell 1/2 <= max(x, y, z) <= 1 to the sphere's: rays at equal angles, layers that grow with the radius.
Vector3d onSphere(const Vector3d& cube) {
  const double side = cube.maxCoeff();
  const Vector3d ray = (cube / side * std::numbers::pi / 4).array().tan();
  return ray.normalized() * kInner * std::pow(kOuter / kInner, 2 * side - 1);
}

/// The eighth of the shell where no coordinate is negative: cubes, `across` of them along its side, six tets each.
TetMesh sphereShell(int across) {
  const TetMesh block = test::barMesh(Eigen::Vector3i::Constant(across), 1. / across);
  TetMesh shell;
  std::vector<std::int32_t> renumbered(block.nodes.size(), -1);
  for (Tet tet : block.tets) {
    Vector3d centroid = Vector3d::Zero();
    for (const std::int32_t n : tet) centroid += block.nodes[static_cast<std::size_t>(n)] / 4;
    if (centroid.maxCoeff() < 0.5) continue;
    for (std::int32_t& n : tet) {
      std::int32_t& number = renumbered[static_cast<std::size_t>(n)];
      if (number < 0) {
        number = static_cast<std::int32_t>(shell.nodes.size());
        shell.nodes.push_back(onSphere(block.nodes[static_cast<std::size_t>(n)]));
      }
      n = number;
    }
    shell.tets.push_back(tet);
  }
  return shell;
}

bool isInner(const Vector3d& place) { return place.norm() < kInner + 1e-9; }

/// The pressure on the triangles of the inner sphere, a third of each to its corners.
NodeVectors pressureOnTheInside(const ElasticBody& body) {
  constexpr std::array<std::array<int, 4>, 4> kFaces{
      {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}}};
  NodeVectors load(body.nodeCount(), Vector3d::Zero());
  for (const Tet& tet : body.tets)
    for (const auto& face : kFaces) {
      const auto at = [&](int c) -> const Vector3d& {
        return body.rest[static_cast<std::size_t>(tet[face[c]])];
      };
      if (!isInner(at(0)) || !isInner(at(1)) || !isInner(at(2))) continue;
      const Vector3d outward =
          (at(1) - at(0)).cross(at(2) - at(0)) / 2;  // of the tet: to the sphere's centre
      for (int c = 0; c < 3; ++c) load[static_cast<std::size_t>(tet[face[c]])] -= kPressure / 3 * outward;
    }
  return load;
}

/// u(r) = p a^3 / (E (b^3 - a^3)) ((1 - 2 nu) r + (1 + nu) b^3 / (2 r^2)).  Source: Timoshenko and Goodier,
/// Theory of Elasticity, section 136.
double radialDisplacement(double r) {
  const double a3 = std::pow(kInner, 3), b3 = std::pow(kOuter, 3);
  return kPressure * a3 / (kYoung * (b3 - a3)) * ((1 - 2 * kPoisson) * r + (1 + kPoisson) * b3 / (2 * r * r));
}

Vector3d exactDisplacement(const Vector3d& place) {
  return radialDisplacement(place.norm()) * place.normalized();
}

/// Nodes slide on the planes of symmetry; where two of these meet, on the axes, they are where the solution has them.
NodeConstraints symmetric(const ElasticBody& body, NodeVectors& places) {
  NodeConstraints constraints(body.nodeCount());
  for (std::size_t n = 0; n < body.nodeCount(); ++n) {
    const Eigen::Array3d onPlane = (body.rest[n].array() < 1e-9).cast<double>();
    if (onPlane.sum() == 2) {
      constraints.freedom[n] = NodeFreedom::Held;
      places[n] += exactDisplacement(body.rest[n]);
    } else if (onPlane.sum() == 1) {
      constraints.freedom[n] = NodeFreedom::Tangential;
      constraints.normals[n] = onPlane;
    }
  }
  return constraints;
}

/// |u - u_exact| over |u_exact|, root of the integrals of their squares.
double displacementError(int across) {
  const ElasticBody body = elasticBody(sphereShell(across));
  NodeVectors places = body.rest;
  const NodeConstraints constraints = symmetric(body, places);
  const auto material = neoHookean(lame(kYoung, kPoisson));
  const EquilibriumReport report =
      findEquilibrium(body, *material, constraints, pressureOnTheInside(body), places, {.tolerance = 1e-4});
  EXPECT_TRUE(report.converged) << report.residual;
  double missed = 0, whole = 0;
  for (std::size_t n = 0; n < body.nodeCount(); ++n) {
    const Vector3d exact = exactDisplacement(body.rest[n]);
    missed += body.masses[n] * (places[n] - body.rest[n] - exact).squaredNorm();
    whole += body.masses[n] * exact.squaredNorm();
  }
  return std::sqrt(missed / whole);
}

// Linear tets: the error falls with the square of their size, all the more the smaller they are.
TEST(ThickSphere, UnderInnerPressureConvergesToTheAnalyticSolution) {
  const double coarse = displacementError(4), middle = displacementError(8), fine = displacementError(16);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.35);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.2);
  EXPECT_LT(fine, 0.02);
}

}  // namespace
}  // namespace sinew
