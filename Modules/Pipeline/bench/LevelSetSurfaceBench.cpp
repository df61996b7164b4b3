#include "LevelSetSurface.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace sinew {
namespace {

double middle(double radius) { return radius + 5; }

DenseLevelSet sphereOfRadius(int voxels) {
  const double centre = middle(voxels);
  DenseLevelSet levelSet;
  levelSet.band = 4;
  levelSet.phi = DenseField(Eigen::Vector3i::Constant(2 * voxels + 11));
  for (int k = 0; k < levelSet.phi.size.z(); ++k)
    for (int j = 0; j < levelSet.phi.size.y(); ++j)
      for (int i = 0; i < levelSet.phi.size.x(); ++i) {
        const double distance = (Eigen::Array3d(i, j, k) - centre).matrix().norm() - voxels;
        levelSet.phi(i, j, k) = static_cast<float>(std::clamp(distance, -4.0, 4.0));
      }
  return levelSet;
}

/// Points of the band in random order: the worst case for the caches.
std::vector<Eigen::Vector3d> bandPoints(double radius) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> offset(-3, 3);
  std::vector<Eigen::Vector3d> points(1 << 16);
  for (Eigen::Vector3d& point : points) {
    point = Eigen::Vector3d(normal(random), normal(random), normal(random));
    point = (point.normalized() * (radius + offset(random))).array() + middle(radius);
  }
  return points;
}

/// The same by rows of a lattice, as a mesher asks.
std::vector<Eigen::Vector3d> sortedBandPoints(double radius) {
  std::vector<Eigen::Vector3d> points = bandPoints(radius);
  const auto row = [](const Eigen::Vector3d& x) {
    const Eigen::Vector3d corner = x.array().floor() / 4;
    return std::tuple(std::floor(corner.x()), std::floor(corner.y()), x.z());
  };
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return row(a) < row(b); });
  return points;
}

using Points = std::vector<Eigen::Vector3d> (*)(double radius);

void value(benchmark::State& state, Points make) {
  const LevelSetSurface surface(sphereOfRadius(int(state.range(0))));
  const std::vector<Eigen::Vector3d> points = make(double(state.range(0)));
  for (auto _ : state) {
    double sum = 0;
    for (const Eigen::Vector3d& point : points) sum += surface.value(point);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(points.size()));
}
BENCHMARK_CAPTURE(value, random, &bandPoints)->Arg(32)->Arg(100)->Arg(250);
BENCHMARK_CAPTURE(value, sorted, &sortedBandPoints)->Arg(32)->Arg(100)->Arg(250);

void valueAndGradient(benchmark::State& state, Points make) {
  const LevelSetSurface surface(sphereOfRadius(int(state.range(0))));
  const std::vector<Eigen::Vector3d> points = make(double(state.range(0)));
  for (auto _ : state) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), gradient;
    for (const Eigen::Vector3d& point : points) {
      surface.valueAndGradient(point, gradient);
      sum += gradient;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(points.size()));
}
BENCHMARK_CAPTURE(valueAndGradient, random, &bandPoints)->Arg(32)->Arg(100)->Arg(250);
BENCHMARK_CAPTURE(valueAndGradient, sorted, &sortedBandPoints)->Arg(32)->Arg(100)->Arg(250);

void construction(benchmark::State& state) {
  const DenseLevelSet levelSet = sphereOfRadius(int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(LevelSetSurface(levelSet));
}
BENCHMARK(construction)->Arg(32)->Arg(100)->Arg(250)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sinew
