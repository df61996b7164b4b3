// OpenVDB's filters as oracles, where they are right.
#include "Sampling.h"
#include "sinew/LevelSet/FastMarching.h"
#include "sinew/LevelSet/MeanCurvatureMotion.h"
#include "sinew/LevelSet/Reinitialize.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetFilter.h>

#include <cmath>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kSize = 48;
constexpr double kOracleSpacing = 0.5, kOracleBand = 3 * kOracleSpacing;

/// A ball with a waist and a bump: both signs of both curvatures.
double shape(const Vector3d& x) {
  const double r = std::hypot(x.x(), x.y());
  return std::hypot(r, x.z()) - 8 - std::cos(0.6 * x.z()) - 0.5 * std::sin(0.7 * x.x());
}

DenseField distanceField() {
  DenseField phi =
      test::sampled(Vector3i::Constant(kSize), Vector3d::Constant(-kOracleSpacing * kSize / 2 + 0.1),
                    Vector3d::Constant(kOracleSpacing), shape);
  fastMarching(phi, Vector3d::Constant(kOracleSpacing), kOracleBand, {.closestPointLayers = 2});
  return phi;
}

openvdb::FloatGrid::Ptr toGrid(const DenseField& phi) {
  openvdb::initialize();
  openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(static_cast<float>(kOracleBand));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(kOracleSpacing));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto values = grid->getAccessor();
  for (int k = 0; k < kSize; ++k)
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i) {
        const float v = phi(i, j, k);
        if (std::abs(v) < kOracleBand)
          values.setValue({i, j, k}, v);
        else if (v < 0)
          values.setValueOff({i, j, k}, v);
      }
  return grid;
}

struct FieldDifference {
  double rms = 0, max = 0;  ///< voxels
};

/// Beside the surface.
FieldDifference difference(const DenseField& phi, const openvdb::FloatGrid& grid) {
  FieldDifference d;
  int count = 0;
  auto values = grid.getConstAccessor();
  for (int k = 0; k < kSize; ++k)
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i) {
        if (!(std::abs(phi(i, j, k)) < 0.5 * kOracleSpacing)) continue;
        const double miss = std::abs(phi(i, j, k) - values.getValue({i, j, k})) / kOracleSpacing;
        d.rms += miss * miss;
        d.max = std::max(d.max, miss);
        ++count;
      }
  EXPECT_GT(count, 1000);
  d.rms = std::sqrt(d.rms / count);
  return d;
}

TEST(OpenVdbOracle, MotionByMeanCurvature) {
  DenseField phi = distanceField();
  const openvdb::FloatGrid::Ptr grid = toGrid(phi);
  openvdb::tools::LevelSetFilter<openvdb::FloatGrid> filter(*grid);
  constexpr int kSteps = 12;  // one call advances b t = h^2/6
  for (int step = 0; step < kSteps; ++step) filter.meanCurvature();
  const DenseField before = phi;
  meanCurvatureMotion(phi, kOracleSpacing, kSteps * kOracleSpacing * kOracleSpacing / 6, kOracleBand);
  const FieldDifference moved = difference(phi, *toGrid(before)), left = difference(phi, *grid);
  EXPECT_GT(moved.rms, 0.3) << "the surface has moved";
  EXPECT_LT(left.rms, 0.02);
  EXPECT_LT(left.max, 0.1);
}

TEST(OpenVdbOracle, ReinitializationByThePdeAndByTheMarch) {
  const DenseField distance = distanceField();
  DenseField bent = distance;
  for (float& v : bent.values) v = std::clamp(1.6F * v, -float{kOracleBand}, float{kOracleBand});
  const openvdb::FloatGrid::Ptr grid = toGrid(bent);
  openvdb::tools::LevelSetFilter<openvdb::FloatGrid> filter(*grid);
  filter.setSpatialScheme(openvdb::math::HJWENO5_BIAS);
  filter.setNormCount(15);
  filter.normalize();
  DenseField pde = bent, march = bent;
  const ReinitializeReport report = reinitialize(pde, kOracleSpacing, kOracleBand);
  fastMarching(march, Vector3d::Constant(kOracleSpacing), kOracleBand, {.closestPointLayers = 2});
  EXPECT_TRUE(report.converged);
  for (const DenseField& ours : {pde, march}) {
    EXPECT_LT(difference(ours, *grid).rms, 0.02) << "OpenVDB alone shifts single samples by up to .24";
    EXPECT_LT(difference(ours, *toGrid(distance)).rms, 0.005) << "where the surface was";
    EXPECT_LT(difference(ours, *toGrid(distance)).max, 0.05);
  }
}

TEST(OpenVdbOracle, TheFirstOrderMarchMovesTheSurfaceAsFarAsSweepingDoes) {
  const DenseField distance = distanceField();
  DenseField ours = distance;
  fastMarching(ours, Vector3d::Constant(kOracleSpacing), kOracleBand, {.order = 1});
  const openvdb::FloatGrid::Ptr swept = openvdb::tools::sdfToSdf(*toGrid(distance));
  const FieldDifference d = difference(ours, *swept);
  EXPECT_LT(d.rms, 0.05);
  EXPECT_GT(difference(distance, *swept).rms, difference(distance, *toGrid(ours)).rms)
      << "closest points shift the surface less than crossings along the axes";
}

}  // namespace
}  // namespace sinew
