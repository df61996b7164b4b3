#include "sinew/Elasticity/HarmonicFibres.h"

#include "NodeSums.h"

#include <Eigen/SparseCore>
// Eigen's iterative solvers need the core first.
#include <Eigen/IterativeLinearSolvers>

#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;
using ShapeGradients = Eigen::Matrix<double, 3, 4>;

/// Gradients of the four shape functions of a tet at rest, 1/mm.
ShapeGradients shapeGradients(const ElasticBody& body, std::size_t tet) {
  ShapeGradients gradients;
  gradients.rightCols<3>() = body.inverseEdges[tet].transpose();
  gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
  return gradients;
}

constexpr double kFree = -1;

/// 0 at the origin, 1 at the insertion, kFree elsewhere.
std::vector<double> attachmentValues(const ElasticBody& body, const std::vector<std::int32_t>& origin,
                                     const std::vector<std::int32_t>& insertion) {
  std::vector<double> values(body.nodeCount(), kFree);
  const auto attach = [&](const std::vector<std::int32_t>& nodes, double value, const std::string& name) {
    if (nodes.empty()) throw std::invalid_argument("harmonicFibres: there is no node at the " + name);
    for (const std::int32_t node : nodes) {
      if (node < 0 || static_cast<std::size_t>(node) >= body.nodeCount())
        throw std::invalid_argument("harmonicFibres: the " + name + " has node " + std::to_string(node) +
                                    ", the body " + std::to_string(body.nodeCount()) + " nodes");
      double& known = values[static_cast<std::size_t>(node)];
      if (known != kFree && known != value)
        throw std::invalid_argument("harmonicFibres: node " + std::to_string(node) +
                                    " is at the origin and at the insertion");
      known = value;
    }
  };
  attach(origin, 0, "origin");
  attach(insertion, 1, "insertion");
  return values;
}

/// The harmonic field with the given values.
Eigen::VectorXd harmonicField(const ElasticBody& body, const std::vector<double>& given) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.nodeCount())), field = right;
  for (std::size_t n = 0; n < given.size(); ++n)
    if (given[n] != kFree) {
      const auto index = static_cast<Eigen::Index>(n);
      entries.emplace_back(n, n, 1);
      right[index] = field[index] = given[n];
    }
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    const ShapeGradients gradients = shapeGradients(body, t);
    const Eigen::Matrix4d stiffness = body.volumes[t] * gradients.transpose() * gradients;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const std::int32_t row = body.tets[t][static_cast<std::size_t>(i)],
                           column = body.tets[t][static_cast<std::size_t>(j)];
        if (given[static_cast<std::size_t>(row)] != kFree) continue;
        if (given[static_cast<std::size_t>(column)] == kFree)
          entries.emplace_back(row, column, stiffness(i, j));
        else
          right[row] -= stiffness(i, j) * given[static_cast<std::size_t>(column)];
      }
  }
  Eigen::SparseMatrix<double> matrix(right.size(), right.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
  solver.setTolerance(1e-10);
  return solver.solveWithGuess(right, field);
}

}  // namespace

NodeVectors harmonicFibres(const ElasticBody& body, const std::vector<std::int32_t>& origin,
                           const std::vector<std::int32_t>& insertion) {
  const Eigen::VectorXd field = harmonicField(body, attachmentValues(body, origin, insertion));
  NodeVectors fibres(body.tets.size(), Vector3d::Zero());
  forEachIndex(body.tets.size(), [&](std::size_t t) {
    const ShapeGradients gradients = shapeGradients(body, t);
    Vector3d gradient = Vector3d::Zero();
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
      gradient += field[body.tets[t][static_cast<std::size_t>(i)]] * gradients.col(i);
      largest = std::max(largest, gradients.col(i).norm());
    }
    constexpr double kFlat = 1e-9;  // what the solver's tolerance leaves
    if (gradient.norm() > kFlat * largest) fibres[t] = gradient.normalized();
  });
  return fibres;
}

}  // namespace sinew
