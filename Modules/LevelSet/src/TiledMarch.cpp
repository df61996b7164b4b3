#include "TiledMarch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace sinew {
namespace {

/// Edge of a tile without its halo, samples: with the halo of a usual band a tile fits a core's cache.
constexpr int kTile = 96;

/// The raster in tiles that are marched one by one, each with a halo as wide as the band reaches: what lies
/// farther cannot be the closest part of the surface. Tiles write their own samples only; of a neighbour's
/// samples they read nothing but the sign, which never changes, hence the relaxed atomic access.
class TiledMarch {
 public:
  TiledMarch(DenseField& phi, const std::vector<std::vector<SurfaceSeed>>& seeds,
             const Eigen::Vector3d& spacing, double band, const BandMarchOptions& options)
      : phi_(phi), seeds_(seeds), spacing_(spacing), band_(band), options_(options) {
    constexpr int kMargin = 2;  // of the differences at the halo's edge
    halo_ = (band / spacing.array()).ceil().cast<int>() + kMargin;
    tiles_ = (phi.size.array() + kTile - 1) / kTile;
  }

  void run() {
    tbb::parallel_for(0, tiles_.prod(), [&](int t) {
      runTile({t % tiles_.x(), t / tiles_.x() % tiles_.y(), t / (tiles_.x() * tiles_.y())});
    });
  }

 private:
  struct Tile {
    Eigen::Vector3i coreLower, coreUpper;  ///< half-open
    Eigen::Vector3i lower, upper;          ///< with the halo
    DenseField phi;                        ///< with kBorder around lower..upper
    std::vector<std::uint32_t> seeds;
  };

  float load(int i, int j, int k) const {
    return std::atomic_ref<float>(phi_(i, j, k)).load(std::memory_order_relaxed);
  }
  void store(int i, int j, int k, float value) {
    std::atomic_ref<float>(phi_(i, j, k)).store(value, std::memory_order_relaxed);
  }

  void runTile(const Eigen::Vector3i& at) {
    Tile tile;
    tile.coreLower = kTile * at;
    tile.coreUpper = (tile.coreLower.array() + kTile).min(phi_.size.array());
    tile.lower = (tile.coreLower - halo_).cwiseMax(0);
    tile.upper = (tile.coreUpper + halo_).cwiseMin(phi_.size);
    if (!hasSeeds(tile))
      return finish(tile, [&](int i, int j, int k) { return load(i, j, k) < 0 ? -kUnreached : kUnreached; });
    fill(tile);
    bandMarch(tile.phi, tile.seeds, spacing_, band_, options_);
    const Eigen::Vector3i shift = Eigen::Vector3i::Constant(kBorder) - tile.lower;
    finish(tile, [&](int i, int j, int k) { return tile.phi(i + shift.x(), j + shift.y(), k + shift.z()); });
  }

  /// Gives visit(seed, slice) the seeds of a tile and its halo, in raster order.
  template <typename Visit>
  void visitSeeds(const Tile& tile, const Visit& visit) const {
    for (int k = tile.lower.z(); k < tile.upper.z(); ++k) {
      const std::vector<SurfaceSeed>& slice = seeds_[static_cast<std::size_t>(k)];
      auto seed = std::partition_point(slice.begin(), slice.end(),
                                       [&](const SurfaceSeed& s) { return s.j < tile.lower.y(); });
      for (; seed != slice.end() && seed->j < tile.upper.y(); ++seed)
        if (seed->i >= tile.lower.x() && seed->i < tile.upper.x()) visit(*seed, k);
    }
  }

  bool hasSeeds(const Tile& tile) const {
    bool any = false;
    visitSeeds(tile, [&](const SurfaceSeed&, int) { any = true; });
    return any;
  }

  void fill(Tile& tile) const {
    tile.phi = DenseField(tile.upper - tile.lower + Eigen::Vector3i::Constant(2 * kBorder), kNowhere);
    const Eigen::Vector3i shift = Eigen::Vector3i::Constant(kBorder) - tile.lower;
    for (int k = tile.lower.z(); k < tile.upper.z(); ++k) {
      for (int j = tile.lower.y(); j < tile.upper.y(); ++j) {
        float* row = tile.phi.row(j + shift.y(), k + shift.z()) + shift.x();
        for (int i = tile.lower.x(); i < tile.upper.x(); ++i)
          row[i] = load(i, j, k) < 0 ? -kUnreached : kUnreached;
      }
    }
    visitSeeds(tile, [&](const SurfaceSeed& seed, int k) {
      const std::size_t n = tile.phi.index(seed.i + shift.x(), seed.j + shift.y(), k + shift.z());
      tile.phi.values[n] = seed.distance;
      tile.seeds.push_back(static_cast<std::uint32_t>(n));
    });
  }

  template <typename Value>
  void finish(const Tile& tile, const Value& value) {
    const auto limit = static_cast<float>(band_);
    for (int k = tile.coreLower.z(); k < tile.coreUpper.z(); ++k)
      for (int j = tile.coreLower.y(); j < tile.coreUpper.y(); ++j)
        for (int i = tile.coreLower.x(); i < tile.coreUpper.x(); ++i)
          store(i, j, k, std::clamp(value(i, j, k), -limit, limit));
  }

  DenseField& phi_;
  const std::vector<std::vector<SurfaceSeed>>& seeds_;
  Eigen::Vector3d spacing_;
  double band_;
  BandMarchOptions options_;
  Eigen::Vector3i halo_, tiles_;
};

}  // namespace

void tiledMarch(DenseField& phi, const std::vector<std::vector<SurfaceSeed>>& seeds,
                const Eigen::Vector3d& spacing, double band, const BandMarchOptions& options) {
  TiledMarch(phi, seeds, spacing, band, options).run();
}

}  // namespace sinew
