#pragma once

#include "sinew/Elasticity/ElasticBody.h"

namespace sinew {

/// Gradients of the four shape functions of a tet at rest as columns, 1/mm: a step d of node c changes F by
/// d g_c^T.
inline Eigen::Matrix<double, 3, 4> shapeGradients(const ElasticBody& body, std::size_t tet) {
  Eigen::Matrix<double, 3, 4> gradients;
  gradients.rightCols<3>() = body.inverseEdges[tet].transpose();
  gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
  return gradients;
}

}  // namespace sinew
