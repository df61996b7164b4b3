#include "sinew/LevelSet/BandDistance.h"

#include "TiledMarch.h"
#include "sinew/LevelSet/FastMarching.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Reach of the exact part, samples: values, normals and curvatures beside the surface stay within it.
constexpr double kNear = 3;

/// Samples at 0, 2, 4, ... along an axis, up to the last one or one beyond.
int coarseSize(int size) { return size / 2 + 1; }

/// Every second sample of a signed distance that is known below `near`: the march's start.
struct CoarseStart {
  DenseField phi;
  std::vector<std::vector<SurfaceSeed>> seeds;
};

CoarseStart everySecondSample(const DenseField& phi, float near) {
  CoarseStart coarse;
  coarse.phi = DenseField(phi.size.unaryExpr(&coarseSize));
  coarse.seeds.resize(static_cast<std::size_t>(coarse.phi.size.z()));
  const Eigen::Vector3i last = phi.size - Eigen::Vector3i::Ones();
  tbb::parallel_for(0, coarse.phi.size.z(), [&](int k) {
    for (int j = 0; j < coarse.phi.size.y(); ++j) {
      const float* in = phi.row(std::min(2 * j, last.y()), std::min(2 * k, last.z()));
      const bool between = 2 * j > last.y() || 2 * k > last.z();
      float* out = coarse.phi.row(j, k);
      for (int i = 0; i < coarse.phi.size.x(); ++i) {
        out[i] = in[std::min(2 * i, last.x())];
        if (std::abs(out[i]) < near && 2 * i <= last.x() && !between)
          coarse.seeds[static_cast<std::size_t>(k)].push_back({i, j, out[i]});
      }
    }
  });
  return coarse;
}

/// The mean of the coarse rows around the fine row (j, k), on twice as many samples.
void interpolateRow(const DenseField& coarse, int j, int k, std::vector<float>& row) {
  const float *a = coarse.row(j / 2, k / 2), *b = coarse.row((j + 1) / 2, k / 2),
              *c = coarse.row(j / 2, (k + 1) / 2), *d = coarse.row((j + 1) / 2, (k + 1) / 2);
  const auto mean = [&](int i) { return 0.25F * ((a[i] + b[i]) + (c[i] + d[i])); };
  float here = mean(0);
  for (int i = 0; i + 1 < coarse.size.x(); ++i) {
    const float next = mean(i + 1);
    row[static_cast<std::size_t>(2 * i)] = here;
    row[static_cast<std::size_t>(2 * i) + 1] = 0.5F * (here + next);
    here = next;
  }
  row[static_cast<std::size_t>(2 * coarse.size.x()) - 2] = here;
}

/// Gives the samples that are not nearer than `near` their distance from the coarse raster.
void fillFar(DenseField& phi, const DenseField& coarse, float near, float band) {
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    std::vector<float> far(2 * static_cast<std::size_t>(coarse.size.x()));
    for (int j = 0; j < phi.size.y(); ++j) {
      interpolateRow(coarse, j, k, far);
      float* row = phi.row(j, k);
      for (int i = 0; i < phi.size.x(); ++i) {
        const float distance = std::clamp(std::abs(far[static_cast<std::size_t>(i)]), near, band);
        row[i] = std::abs(row[i]) < near ? row[i] : std::copysign(distance, row[i]);
      }
    }
  });
}

}  // namespace

void bandDistance(DenseField& phi, const Eigen::Vector3d& spacing, double band) {
  const double near = kNear * spacing.maxCoeff();
  if (!(near < band)) return fastMarching(phi, spacing, band);
  fastMarching(phi, spacing, near);
  CoarseStart coarse = everySecondSample(phi, static_cast<float>(near));
  const double cell = 2 * spacing.maxCoeff();  // what surrounds a sample of the band has its own distance
  tiledMarch(coarse.phi, coarse.seeds, 2 * spacing, band + cell);
  fillFar(phi, coarse.phi, static_cast<float>(near), static_cast<float>(band));
}

}  // namespace sinew
