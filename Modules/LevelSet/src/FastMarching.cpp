#include "sinew/LevelSet/FastMarching.h"

#include "SurfaceSeeds.h"
#include "TiledMarch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

namespace sinew {
namespace {

void checkArguments(const std::string& function, const Eigen::Vector3d& spacing, double band,
                    const FastMarchingOptions& options) {
  if (!(spacing.array() > 0).all() || !(band > 0))
    throw std::invalid_argument(function + ": spacing and band must be positive");
  const auto require = [&](bool holds, const char* what, int value) {
    if (!holds) throw std::invalid_argument(function + ": " + what + ", got " + std::to_string(value));
  };
  require(options.order == 1 || options.order == 2, "order must be 1 or 2", options.order);
  require(options.closestPointLayers >= 1 && options.closestPointLayers <= 3,
          "closestPointLayers must lie in [1, 3]", options.closestPointLayers);
}

void checkSeed(const MarchSeed& seed, const Eigen::Vector3i& size) {
  const auto named = [&](const char* what) {
    return "marchFromSeeds: seed (" + std::to_string(seed.at.x()) + ", " + std::to_string(seed.at.y()) +
           ", " + std::to_string(seed.at.z()) + ") " + what;
  };
  if ((seed.at.array() < 0).any() || (seed.at.array() >= size.array()).any())
    throw std::invalid_argument(named("lies outside of the raster"));
  if (!(seed.distance >= 0) || !std::isfinite(seed.distance))
    throw std::invalid_argument(named("must have a distance of at least 0, got ") +
                                std::to_string(seed.distance));
}

/// The seeds in raster order, one for a sample, with the sign of its side.
std::vector<std::vector<SurfaceSeed>> sliceBySlice(const DenseField& phi, const std::vector<MarchSeed>& seeds,
                                                   double leastInside) {
  std::vector<std::vector<SurfaceSeed>> slices(static_cast<std::size_t>(phi.size.z()));
  for (const MarchSeed& seed : seeds) {
    checkSeed(seed, phi.size);
    slices[static_cast<std::size_t>(seed.at.z())].push_back(
        {seed.at.x(), seed.at.y(), static_cast<float>(seed.distance)});
  }
  for (int k = 0; k < phi.size.z(); ++k) {
    std::vector<SurfaceSeed>& slice = slices[static_cast<std::size_t>(k)];
    std::sort(slice.begin(), slice.end(), [](const SurfaceSeed& a, const SurfaceSeed& b) {
      return std::tie(a.j, a.i, a.distance) < std::tie(b.j, b.i, b.distance);
    });
    const auto sameSample = [](const SurfaceSeed& a, const SurfaceSeed& b) {
      return a.i == b.i && a.j == b.j;
    };
    slice.erase(std::unique(slice.begin(), slice.end(), sameSample), slice.end());
    for (SurfaceSeed& seed : slice)
      if (phi(seed.i, seed.j, k) < 0)
        seed.distance = -std::max(seed.distance, static_cast<float>(leastInside));
  }
  return slices;
}

}  // namespace

void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band,
                  const FastMarchingOptions& options) {
  checkArguments("fastMarching", spacing, band, options);
  // A closest point that is farther away than the march finds it belongs to another sheet.
  constexpr double kSameSheet = 0.1;  // samples
  const double keepWithin = options.closestPointLayers > 1 ? kSameSheet * spacing.minCoeff() : 0;
  tiledMarch(phi, surfaceSeeds(phi, spacing, options.closestPointLayers), spacing, band,
             {.order = options.order, .keepWithin = keepWithin});
}

void marchFromSeeds(DenseField& phi, const std::vector<MarchSeed>& seeds, const Eigen::Vector3d& spacing,
                    double band, const FastMarchingOptions& options) {
  checkArguments("marchFromSeeds", spacing, band, options);
  const double leastInside = 1e-6 * spacing.minCoeff();  // zero would be outside
  tiledMarch(
      phi, sliceBySlice(phi, seeds, leastInside), spacing, band,
      {.order = options.order, .fixBeside = false, .keepWithin = std::numeric_limits<double>::infinity()});
}

}  // namespace sinew
