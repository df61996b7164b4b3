#include "sinew/LevelSet/SurfaceLevel.h"

#include "sinew/LevelSet/GaussianSmoothing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

/// Sums over the faces of the digital surface, on a raster that is coarser by `factor`.
struct FaceSums {
  Eigen::Vector3i factor;
  DenseField level;  ///< sum of u at the faces
  DenseField count;  ///< number of faces
};

/// u half way between samples 1 and 2 of four in a row (cubic through all four).
float midpoint(float u0, float u1, float u2, float u3) { return 0.5625F * (u1 + u2) - 0.0625F * (u0 + u3); }

/// Adds the faces across which the mask changes from voxel (i,j,k) to its next neighbour along `axis`.
void addFace(FaceSums& sums, const DenseField& u, const DenseMask& mask, int axis,
             const Eigen::Vector3i& at) {
  const Eigen::Vector3i step = Eigen::Vector3i::Unit(axis);
  const Eigen::Vector3i next = at + step;
  if (mask(at.x(), at.y(), at.z()) == mask(next.x(), next.y(), next.z())) return;
  const Eigen::Vector3i before = (at - step).cwiseMax(0);
  const Eigen::Vector3i after = (next + step).cwiseMin(u.size - Eigen::Vector3i::Ones());
  const Eigen::Vector3i cell = at.cwiseQuotient(sums.factor);
  sums.level(cell.x(), cell.y(), cell.z()) +=
      midpoint(u(before.x(), before.y(), before.z()), u(at.x(), at.y(), at.z()),
               u(next.x(), next.y(), next.z()), u(after.x(), after.y(), after.z()));
  sums.count(cell.x(), cell.y(), cell.z()) += 1;
}

FaceSums sumFaces(const DenseField& u, const DenseMask& mask, const Eigen::Vector3d& sigma) {
  FaceSums sums;
  for (int a = 0; a < 3; ++a) sums.factor[a] = sigma[a] > 0 ? 2 : 1;
  const Eigen::Vector3i coarse = (u.size + sums.factor - Eigen::Vector3i::Ones()).cwiseQuotient(sums.factor);
  sums.level = DenseField(coarse);
  sums.count = DenseField(coarse);
  tbb::parallel_for(0, coarse.z(), [&](int slab) {
    const int last = std::min((slab + 1) * sums.factor.z(), u.size.z());
    for (int k = slab * sums.factor.z(); k < last; ++k)
      for (int j = 0; j < u.size.y(); ++j)
        for (int i = 0; i < u.size.x(); ++i) {
          const float here = u(i, j, k);
          if (here <= 0 || here >= 1) continue;  // a face lies within the reach of the kernel
          const Eigen::Vector3i at(i, j, k);
          for (int a = 0; a < 3; ++a)
            if (sigma[a] > 0 && at[a] + 1 < u.size[a]) addFace(sums, u, mask, a, at);
        }
  });
  return sums;
}

/// Trilinear weights of a fine sample among the coarse ones, along one axis.
struct Blend {
  int lower, upper;
  float upperWeight;
};

std::vector<Blend> blends(int fine, int factor, int coarse) {
  std::vector<Blend> table;
  for (int i = 0; i < fine; ++i) {
    const double x = (i + 0.5) / factor - 0.5;
    const int lower = static_cast<int>(std::floor(x));
    table.push_back({std::clamp(lower, 0, coarse - 1), std::clamp(lower + 1, 0, coarse - 1),
                     static_cast<float>(x - lower)});
  }
  return table;
}

float sample(const DenseField& f, const Blend& x, const Blend& y, const Blend& z) {
  const auto alongX = [&](int j, int k) {
    const float* row = f.row(j, k);
    return row[x.lower] + x.upperWeight * (row[x.upper] - row[x.lower]);
  };
  const auto alongY = [&](int k) {
    const float low = alongX(y.lower, k);
    return low + y.upperWeight * (alongX(y.upper, k) - low);
  };
  const float low = alongY(z.lower);
  return low + z.upperWeight * (alongY(z.upper) - low);
}

float smoothStep(float x) {
  const float t = std::clamp(x, 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace

void subtractSurfaceLevel(DenseField& field, const DenseMask& mask, const Eigen::Vector3d& sigmaVoxels,
                          double iso, const SurfaceLevelOptions& options) {
  if (field.size != mask.size)
    throw std::invalid_argument("subtractSurfaceLevel: the mask does not have the size of the field");
  FaceSums sums = sumFaces(field, mask, sigmaVoxels);
  Eigen::Vector3d window;
  std::array<std::vector<Blend>, 3> blend;
  for (int a = 0; a < 3; ++a) {
    window[a] = sigmaVoxels[a] > 0 ? options.windowVoxels / sums.factor[a] : 0;
    blend[static_cast<std::size_t>(a)] = blends(field.size[a], sums.factor[a], sums.level.size[a]);
  }
  gaussianSmoothing(sums.level, window);
  gaussianSmoothing(sums.count, window);

  const auto global = static_cast<float>(iso), tolerated = static_cast<float>(options.tolerated),
             range = static_cast<float>(options.full - options.tolerated);
  tbb::parallel_for(0, field.size.z(), [&](int k) {
    for (int j = 0; j < field.size.y(); ++j) {
      float* row = field.row(j, k);
      for (int i = 0; i < field.size.x(); ++i) {
        const float u = row[i];
        row[i] = global - u;
        if (u <= 0 || u >= 1) continue;
        const Blend &x = blend[0][static_cast<std::size_t>(i)], &y = blend[1][static_cast<std::size_t>(j)],
                    &z = blend[2][static_cast<std::size_t>(k)];
        const float faces = sample(sums.count, x, y, z);
        constexpr float kNoFaces = 1e-6F;
        if (faces < kNoFaces) continue;
        const float deviation = sample(sums.level, x, y, z) / faces - global;
        row[i] += deviation * smoothStep((std::abs(deviation) - tolerated) / range);
      }
    }
  });
}

}  // namespace sinew
