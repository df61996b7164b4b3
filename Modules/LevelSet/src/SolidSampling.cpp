#include "LatticeBox.h"
#include "RigidScaling.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/Solid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// Edge of the blocks that are evaluated or skipped as a whole, samples.
constexpr int kBlock = 8;

bool isFinite(const AlignedBox3d& box) { return box.min().allFinite() && box.max().allFinite(); }

bool holds(const AlignedBox3d& outer, const AlignedBox3d& inner) {
  return (outer.min().array() <= inner.min().array()).all() &&
         (inner.max().array() <= outer.max().array()).all();
}

/// What is left of a solid inside of a box; one of both is finite along every axis.
Solid cutOff(const Solid& solid, const AlignedBox3d& within, double band) {
  if (holds(within, solid.bounds)) return solid;
  const Vector3d margin = Vector3d::Constant(band);  // sides of `within` farther out cut nothing
  const AlignedBox3d cut =
      within.intersection(AlignedBox3d(solid.bounds.min() - margin, solid.bounds.max() + margin));
  const auto phi = [inside = solid.phi, inBox = box(cut.min(), cut.max()).phi](const Vector3d& x) {
    return std::max(inside(x), inBox(x));
  };
  return {phi, within.intersection(solid.bounds), false};
}

void evaluateBlock(const Solid& solid, DenseLevelSet& levelSet, const Vector3i& lower) {
  const Vector3i upper = (lower.array() + kBlock).min(levelSet.phi.size.array());
  const double h = levelSet.voxelSize, band = levelSet.band;
  const auto at = [&](const Vector3d& index) -> Vector3d { return levelSet.frame * (h * index); };
  const Vector3d middle = (lower + upper - Vector3i::Ones()).cast<double>() / 2;
  const double radius = h * (upper - lower - Vector3i::Ones()).cast<double>().norm() / 2;
  const double phi = solid.phi(at(middle));
  const bool far = std::abs(phi) >= band + radius;
  for (int k = lower.z(); k < upper.z(); ++k)
    for (int j = lower.y(); j < upper.y(); ++j)
      for (int i = lower.x(); i < upper.x(); ++i)
        levelSet.phi(i, j, k) =
            static_cast<float>(std::clamp(far ? phi : solid.phi(at(Vector3d(i, j, k))), -band, band));
}

}  // namespace

Solid moved(const Solid& solid, const Eigen::Affine3d& motion) {
  const double scale = evenScale(motion, "moved");
  const Eigen::Affine3d back = motion.inverse();
  const auto phi = [inner = solid.phi, back, scale](const Vector3d& x) { return scale * inner(back * x); };
  return {phi, isFinite(solid.bounds) ? solid.bounds.transformed(motion) : solid.bounds, solid.distance};
}

DenseLevelSet sampleSolid(const Solid& solid, const SampleLattice& lattice, double band,
                          const AlignedBox3d& within, std::int64_t mostSamples) {
  const AlignedBox3d bounds = solid.bounds.intersection(within);
  if (!(bounds.sizes().array() > 0).all())
    return emptyLevelSet(lattice, Vector3i::Zero(), Vector3i::Zero(), band);
  if (!isFinite(bounds)) throw std::invalid_argument("sampleSolid: the solid must end within a finite box");
  const LatticeBox samples = latticeBox(bounds.transformed(lattice.frame.inverse()), lattice.spacing,
                                        band + lattice.spacing, "sampleSolid", mostSamples);
  DenseLevelSet result = emptyLevelSet(lattice, samples.lower, samples.upper, band);
  const Solid piece = cutOff(solid, within, band);
  const Vector3i blocks = (result.phi.size.array() + kBlock - 1) / kBlock;
  tbb::parallel_for(0, blocks.z() * blocks.y(), [&](int n) {
    for (int i = 0; i < blocks.x(); ++i)
      evaluateBlock(piece, result, kBlock * Vector3i(i, n % blocks.y(), n / blocks.y()));
  });
  if (!piece.distance) redistance(result);
  return result;
}

}  // namespace sinew
