#include "sinew/Elasticity/HarmonicField.h"

#include "ShapeGradients.h"

#include <Eigen/SparseCore>
// Eigen's iterative solvers need the core first.
#include <Eigen/IterativeLinearSolvers>

#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {

std::vector<double> harmonicField(const ElasticBody& body, const std::vector<double>& given) {
  if (given.size() != body.nodeCount())
    throw std::invalid_argument("harmonicField: there are " + std::to_string(given.size()) + " values for " +
                                std::to_string(body.nodeCount()) + " nodes");
  const auto wanted = [&](std::int32_t node) { return std::isnan(given[static_cast<std::size_t>(node)]); };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(body.nodeCount())), field = right;
  for (std::int32_t n = 0; n < right.size(); ++n)
    if (!wanted(n)) {
      entries.emplace_back(n, n, 1);
      right[n] = field[n] = given[static_cast<std::size_t>(n)];
    }
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    const Eigen::Matrix<double, 3, 4> gradients = shapeGradients(body, t);
    const Eigen::Matrix4d stiffness = body.volumes[t] * gradients.transpose() * gradients;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const std::int32_t row = body.tets[t][static_cast<std::size_t>(i)],
                           column = body.tets[t][static_cast<std::size_t>(j)];
        if (!wanted(row)) continue;
        if (wanted(column))
          entries.emplace_back(row, column, stiffness(i, j));
        else
          right[row] -= stiffness(i, j) * given[static_cast<std::size_t>(column)];
      }
  }
  Eigen::SparseMatrix<double> matrix(right.size(), right.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
  solver.setTolerance(1e-10);
  field = solver.solveWithGuess(right, field);
  return {field.begin(), field.end()};
}

}  // namespace sinew
