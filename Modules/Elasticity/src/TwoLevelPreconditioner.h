#pragma once

#include "StiffnessMatrix.h"
#include "sinew/Elasticity/NodeConstraints.h"

#include <Eigen/SparseCore>
// Eigen's solvers need the core first.
#include <Eigen/SparseCholesky>

#include <cstdint>

namespace sinew {

/// An approximation of K^-1 for conjugate gradients: the inverses of the diagonal blocks, which know what happens next
/// to a node, plus the exact answer among motions in which patches of nodes move rigidly, which know the whole body:
///     M^-1 = D^-1 + P (P^T K P)^-1 P^T
/// The number of steps then depends on the nodes of a patch, and not on those of the body.
/// Source: Nicolaides 1987, Deflation of conjugate gradients; rigid patches as in Jonsthovel et al. 2012; additive
/// form: Smith, Bjorstad and Gropp 1996, Domain Decomposition, section 2.3.
class TwoLevelPreconditioner {
 public:
  /// Chooses the patches. Cost: O(blocks).
  TwoLevelPreconditioner(const ElasticBody& body, const StiffnessMatrix& matrix,
                         const NodeConstraints& constraints);

  /// The inverses for the matrix as it stands; parts that are not positive definite are made so.
  void update();

  /// out = M^-1 in
  void apply(const NodeVectors& in, NodeVectors& out) const;

 private:
  using Modes = Eigen::Matrix<double, 3, 6>;  // what a node does in the six rigid motions of its patch
  using CoarseMatrix = Eigen::SparseMatrix<double>;

  CoarseMatrix coarseMatrix() const;

  const StiffnessMatrix& matrix_;
  const NodeConstraints& constraints_;
  std::vector<std::int32_t> patchOf_;              // -1 for held nodes
  std::vector<std::vector<std::size_t>> patches_;  // their nodes
  std::vector<Modes> modes_;
  std::vector<Eigen::Matrix3d> inverseDiagonals_;
  Eigen::SimplicialLLT<CoarseMatrix> coarse_;
  bool coarseIsPositive_ = false;
};

}  // namespace sinew
