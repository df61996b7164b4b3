#pragma once

#include "sinew/Elasticity/ElasticBody.h"
#include "sinew/Elasticity/Material.h"

#include <array>

namespace sinew {

/// K = -df/dx of the elastic forces of a body in 3 x 3 blocks, one for each pair of nodes that share a tet. All of it
/// is kept, so that every row is summed and multiplied by one task, in the same order for any number of threads.
class StiffnessMatrix {
 public:
  /// Only the pattern. Cost: O(tets).
  explicit StiffnessMatrix(const ElasticBody& body);

  /// The entries at places. Cost: O(tets), about that of 30 products.
  void assemble(const Material& material, const NodeVectors& places);

  /// out = K in
  void multiply(const NodeVectors& in, NodeVectors& out) const;

  std::size_t rows() const { return firstBlock_.size() - 1; }
  const Eigen::Matrix3d& diagonal(std::size_t row) const { return blocks_[diagonals_[row]]; }

  /// Calls f(column, block) for the blocks of a row, from the left.
  template <class Function>
  void forEachBlock(std::size_t row, const Function& f) const {
    for (std::size_t b = firstBlock_[row]; b < firstBlock_[row + 1]; ++b) f(columns_[b], blocks_[b]);
  }

 private:
  const ElasticBody& body_;
  std::vector<std::size_t> firstBlock_, diagonals_;
  std::vector<std::size_t> columns_;
  std::vector<Eigen::Matrix3d> blocks_;
  std::vector<std::array<std::int32_t, 4>>
      target_;  // of corner k of the body: the blocks of its row it adds to
};

}  // namespace sinew
