#pragma once

#include "sinew/Mesher/SignedDistance.h"

#include <algorithm>
#include <cmath>

namespace sinew {

/// The shape grown by `offset` on all sides, or shrunk where that is negative: phi - offset. The base must
/// outlive it.
class OffsetSurface final : public SignedDistance {
 public:
  /// @param offset  mm, well below the base's band
  OffsetSurface(const SignedDistance& base, double offset) : base_(base), offset_(offset) {}

  double value(const Eigen::Vector3d& x) const override { return base_.value(x) - offset_; }
  double valueAndGradient(const Eigen::Vector3d& x, Eigen::Vector3d& gradient) const override {
    return base_.valueAndGradient(x, gradient) - offset_;
  }
  Eigen::AlignedBox3d bounds() const override {
    const Eigen::AlignedBox3d box = base_.bounds();
    const double growth = std::max(offset_, 0.);
    return {box.min().array() - growth, box.max().array() + growth};
  }
  double resolution() const override { return base_.resolution(); }
  double band() const override { return base_.band() - std::abs(offset_); }

 private:
  const SignedDistance& base_;
  double offset_;
};

}  // namespace sinew
