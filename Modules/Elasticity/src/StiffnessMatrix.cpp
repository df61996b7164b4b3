#include "StiffnessMatrix.h"

#include "NodeSums.h"
#include "ShapeGradients.h"

#include <algorithm>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// dP/dF of a tet, F and P as columns below each other.
using Tangent = Eigen::Matrix<double, 9, 9>;

std::vector<Tangent> tangents(const ElasticBody& body, const Material& material, const NodeVectors& places) {
  std::vector<Tangent> result(body.tets.size());
  forEachIndex(result.size(), [&](std::size_t t) {
    const Matrix3d F = deformationGradient(body, places, t);
    for (int entry = 0; entry < 9; ++entry) {
      Matrix3d unit = Matrix3d::Zero();
      unit(entry % 3, entry / 3) = 1;
      result[t].col(entry) = material.stressChange(t, F, unit).reshaped();
    }
  });
  return result;
}

}  // namespace

StiffnessMatrix::StiffnessMatrix(const ElasticBody& body)
    : body_(body),
      firstBlock_(body.nodeCount() + 1, 0),
      diagonals_(body.nodeCount()),
      target_(body.corners.size()) {
  std::vector<std::vector<std::size_t>> rows(body.nodeCount());
  const auto cornersOf = [&](std::size_t n, const auto& f) {
    for (std::int32_t k = body.firstCorner[n]; k < body.firstCorner[n + 1]; ++k)
      f(static_cast<std::size_t>(k),
        body.tets[static_cast<std::size_t>(body.corners[static_cast<std::size_t>(k)]) / 4]);
  };
  forEachIndex(rows.size(), [&](std::size_t n) {
    std::vector<std::size_t>& row = rows[n];
    row.push_back(n);
    cornersOf(n, [&](std::size_t, const Tet& tet) { row.insert(row.end(), tet.begin(), tet.end()); });
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
  });
  for (std::size_t n = 0; n < rows.size(); ++n) firstBlock_[n + 1] = firstBlock_[n] + rows[n].size();
  columns_.resize(firstBlock_.back());
  blocks_.resize(firstBlock_.back());
  forEachIndex(rows.size(), [&](std::size_t n) {
    const std::vector<std::size_t>& row = rows[n];
    const auto place = [&](std::size_t column) {
      return static_cast<std::size_t>(std::ranges::lower_bound(row, column) - row.begin());
    };
    std::ranges::copy(row, columns_.begin() + static_cast<std::ptrdiff_t>(firstBlock_[n]));
    diagonals_[n] = firstBlock_[n] + place(n);
    cornersOf(n, [&](std::size_t k, const Tet& tet) {
      for (std::size_t c = 0; c < 4; ++c)
        target_[k][c] = static_cast<std::int32_t>(place(static_cast<std::size_t>(tet[c])));
    });
  });
}

/// Block (a, b) of a tet is V (g_a^T x I) T (g_b x I), T = dP/dF.
void StiffnessMatrix::assemble(const Material& material, const NodeVectors& places) {
  const std::vector<Tangent> tangent = tangents(body_, material, places);
  forEachIndex(rows(), [&](std::size_t n) {
    Matrix3d* const row = &blocks_[firstBlock_[n]];
    std::fill(row, &blocks_[firstBlock_[n + 1]], Matrix3d::Zero());
    for (std::int32_t k = body_.firstCorner[n]; k < body_.firstCorner[n + 1]; ++k) {
      const auto corner = static_cast<std::size_t>(body_.corners[static_cast<std::size_t>(k)]);
      const std::size_t tet = corner / 4;
      const Eigen::Matrix<double, 3, 4> g = shapeGradients(body_, tet);
      const Vector3d left = body_.volumes[tet] * g.col(static_cast<Eigen::Index>(corner % 4));
      const Eigen::Matrix<double, 3, 9> half = left[0] * tangent[tet].topRows<3>() +
                                               left[1] * tangent[tet].middleRows<3>(3) +
                                               left[2] * tangent[tet].bottomRows<3>();
      for (int b = 0; b < 4; ++b)
        row[target_[static_cast<std::size_t>(k)][static_cast<std::size_t>(b)]] +=
            g(0, b) * half.leftCols<3>() + g(1, b) * half.middleCols<3>(3) + g(2, b) * half.rightCols<3>();
    }
  });
}

void StiffnessMatrix::multiply(const NodeVectors& in, NodeVectors& out) const {
  forEachIndex(rows(), [&](std::size_t n) {
    Vector3d sum = Vector3d::Zero();
    forEachBlock(n, [&](std::size_t column, const Matrix3d& block) { sum += block * in[column]; });
    out[n] = sum;
  });
}

}  // namespace sinew
