#include "sinew/LevelSet/PrincipalCurvatures.h"

#include "BandRuns.h"

#include <Eigen/Core>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

void checkSpacing(double spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw std::invalid_argument("principalCurvatures: spacing must be positive, got " +
                                std::to_string(spacing));
}

PrincipalCurvatures curvatures(const Derivatives& d, double spacing) {
  const Eigen::Vector3d gradient = Eigen::Vector3d(d.x, d.y, d.z) / spacing;
  const double slope = gradient.norm();
  if (slope == 0) return {};
  Eigen::Matrix3d hessian;
  hessian << d.xx, d.xy, d.xz, d.xy, d.yy, d.yz, d.xz, d.yz, d.zz;
  hessian /= spacing * spacing;
  const Eigen::Vector3d n = gradient / slope;
  const Eigen::Matrix3d p = Eigen::Matrix3d::Identity() - n * n.transpose();
  const Eigen::Matrix3d bend = p * hessian * p / slope;
  const double sum = bend.trace(), squares = bend.squaredNorm();
  const double half = std::sqrt(std::max(0.0, 2 * squares - sum * sum)) / 2;  // (k1 - k2)/2
  return {sum / 2 + half, sum / 2 - half};
}

PrincipalCurvatures curvaturesAt(const DenseField& phi, double spacing, const RowStencil& rows, int i) {
  return curvatures(derivatives(rows, std::max(i - 1, 0), i, std::min(i + 1, phi.size.x() - 1)), spacing);
}

}  // namespace

PrincipalCurvatures principalCurvatures(const DenseField& phi, double spacing, const Eigen::Vector3i& at) {
  checkSpacing(spacing);
  if ((at.array() < 0).any() || (at.array() >= phi.size.array()).any())
    throw std::invalid_argument("principalCurvatures: the sample must lie in the raster");
  return curvaturesAt(phi, spacing, RowStencil(phi, at.y(), at.z()), at.x());
}

CurvatureFields principalCurvatures(const DenseField& phi, double spacing, double within) {
  checkSpacing(spacing);
  CurvatureFields fields{DenseField(phi.size), DenseField(phi.size)};
  const std::vector<BandSlice> slices = bandRuns(phi, static_cast<float>(within));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    for (const BandRun& run : slices[static_cast<std::size_t>(k)].runs) {
      const RowStencil rows(phi, run.j, k);
      for (int i = run.first; i < run.last; ++i) {
        const PrincipalCurvatures c = curvaturesAt(phi, spacing, rows, i);
        fields.k1(i, run.j, k) = static_cast<float>(c.k1);
        fields.k2(i, run.j, k) = static_cast<float>(c.k2);
      }
    }
  });
  return fields;
}

}  // namespace sinew
