#include "TwoLevelPreconditioner.h"

#include "NodeSums.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <queue>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kPatchNodes = 40;
constexpr std::size_t kLeastPatchNodes = 4;  // of fewer the rigid motions are not independent

/// The nodes that may move in connected patches of kPatchNodes, each grown breadth first from the first node left.
std::vector<std::vector<std::size_t>> growPatches(const StiffnessMatrix& matrix,
                                                  const NodeConstraints& constraints) {
  constexpr std::int8_t kLeft = 0, kSeen = 1, kTaken = 2;
  std::vector<std::int8_t> state(matrix.rows(), kLeft);
  for (std::size_t n = 0; n < state.size(); ++n)
    if (constraints.freedom[n] == NodeFreedom::Held) state[n] = kTaken;
  std::vector<std::vector<std::size_t>> patches;
  for (std::size_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] == kTaken) continue;
    std::vector<std::size_t> patch, seen{seed};
    state[seed] = kSeen;
    for (std::size_t next = 0; next < seen.size() && patch.size() < kPatchNodes; ++next) {
      patch.push_back(seen[next]);
      state[seen[next]] = kTaken;
      matrix.forEachBlock(seen[next], [&](std::size_t neighbour, const Matrix3d&) {
        if (state[neighbour] != kLeft) return;
        state[neighbour] = kSeen;
        seen.push_back(neighbour);
      });
    }
    for (const std::size_t n : seen)
      if (state[n] == kSeen) state[n] = kLeft;
    patches.push_back(std::move(patch));
  }
  return patches;
}

Matrix3d crossProductMatrix(const Vector3d& v) {
  Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

Matrix3d positiveInverse(const Matrix3d& block) {
  const Eigen::LLT<Matrix3d> factors(block);
  if (factors.info() == Eigen::Success) return factors.solve(Matrix3d::Identity());
  return Matrix3d::Identity() / std::max(block.norm(), 1e-300);
}

}  // namespace

TwoLevelPreconditioner::TwoLevelPreconditioner(const ElasticBody& body, const StiffnessMatrix& matrix,
                                               const NodeConstraints& constraints)
    : matrix_(matrix),
      constraints_(constraints),
      patchOf_(matrix.rows(), -1),
      patches_(growPatches(matrix, constraints)),
      modes_(matrix.rows(), Modes::Zero()),
      inverseDiagonals_(matrix.rows()) {
  std::erase_if(patches_, [](const auto& patch) { return patch.size() < kLeastPatchNodes; });
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    Vector3d middle = Vector3d::Zero();
    for (const std::size_t n : patches_[p]) middle += body.rest[n] / static_cast<double>(patches_[p].size());
    double radius = 0;
    for (const std::size_t n : patches_[p]) radius = std::max(radius, (body.rest[n] - middle).norm());
    for (const std::size_t n : patches_[p]) {
      patchOf_[n] = static_cast<std::int32_t>(p);
      modes_[n] << Matrix3d::Identity(), crossProductMatrix((body.rest[n] - middle) / radius);
      for (int mode = 0; mode < 6; ++mode) modes_[n].col(mode) = constraints.free(n, modes_[n].col(mode));
    }
  }
}

/// P^T K P, a block of 6 x 6 for each pair of patches with neighbours.
TwoLevelPreconditioner::CoarseMatrix TwoLevelPreconditioner::coarseMatrix() const {
  using Block = Eigen::Matrix<double, 6, 6>;
  std::vector<std::vector<std::pair<std::int32_t, Block>>> rows(patches_.size());
  tbb::parallel_for(std::size_t{0}, patches_.size(), [&](std::size_t p) {
    for (const std::size_t n : patches_[p])
      matrix_.forEachBlock(n, [&](std::size_t column, const Matrix3d& block) {
        const std::int32_t other = patchOf_[column];
        if (other < 0 || static_cast<std::size_t>(other) > p) return;
        auto found = std::ranges::find(rows[p], other, [](const auto& entry) { return entry.first; });
        if (found == rows[p].end()) found = rows[p].insert(found, {other, Block::Zero()});
        found->second += modes_[n].transpose() * block * modes_[column];
      });
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (const auto& [other, block] : rows[p])
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          entries.emplace_back(6 * static_cast<std::int32_t>(p) + i, 6 * other + j, block(i, j));
  CoarseMatrix result(static_cast<Eigen::Index>(6 * patches_.size()),
                      static_cast<Eigen::Index>(6 * patches_.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void TwoLevelPreconditioner::update() {
  forEachIndex(matrix_.rows(),
               [&](std::size_t n) { inverseDiagonals_[n] = positiveInverse(matrix_.diagonal(n)); });
  if (patches_.empty()) return;
  const CoarseMatrix coarse = coarseMatrix();
  const double mean = coarse.diagonal().cwiseAbs().mean();
  coarseIsPositive_ = false;
  for (double shift = 1e-10; shift < 1 && !coarseIsPositive_; shift *= 100) {
    coarse_.setShift(shift * mean);
    coarse_.compute(coarse);
    coarseIsPositive_ = coarse_.info() == Eigen::Success;
  }
}

void TwoLevelPreconditioner::apply(const NodeVectors& in, NodeVectors& out) const {
  Eigen::VectorXd motion;
  if (coarseIsPositive_) {
    Eigen::VectorXd forces(static_cast<Eigen::Index>(6 * patches_.size()));
    tbb::parallel_for(std::size_t{0}, patches_.size(), [&](std::size_t p) {
      Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
      for (const std::size_t n : patches_[p]) force += modes_[n].transpose() * in[n];
      forces.segment<6>(static_cast<Eigen::Index>(6 * p)) = force;
    });
    motion = coarse_.solve(forces);
  }
  forEachIndex(in.size(), [&](std::size_t n) {
    out[n] = inverseDiagonals_[n] * in[n];
    if (coarseIsPositive_ && patchOf_[n] >= 0)
      out[n] += modes_[n] * motion.segment<6>(6 * Eigen::Index{patchOf_[n]});
    out[n] = constraints_.free(n, out[n]);
  });
}

}  // namespace sinew
