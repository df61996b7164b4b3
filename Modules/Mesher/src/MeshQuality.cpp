#include "sinew/Mesher/MeshQuality.h"

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sinew {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// |V| / (longest edge)^3 up to which a tet counts as flat: its volume is rounding.
constexpr double kFlatness = 1e-12;

/// Tets per task; fixed, because it decides the order of the sums.
constexpr std::size_t kGrain = 4096;

double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

/// Squared lengths of the six edges, shortest and longest.
struct EdgeRange {
  double shortest = kInfinity;
  double longest = 0;
};

EdgeRange squaredEdges(const std::array<Eigen::Vector3d, 4>& x) {
  EdgeRange range;
  for (const auto& [i, j] : kTetEdges) {
    const double squared = (x[j] - x[i]).squaredNorm();
    range.shortest = std::min(range.shortest, squared);
    range.longest = std::max(range.longest, squared);
  }
  return range;
}

TetQuality qualityOf(const std::array<Eigen::Vector3d, 4>& x, double longestEdge) {
  std::array<Eigen::Vector3d, 4> normal;
  double largestArea = 0;
  for (int f = 0; f < 4; ++f) {
    const auto& [i, j, k] = kTetFaces[f];
    const Eigen::Vector3d n = (x[j] - x[i]).cross(x[k] - x[i]);
    const double length = n.norm();
    largestArea = std::max(largestArea, length / 2);
    normal[f] = n / std::max(length, std::numeric_limits<double>::min());
  }
  // Faces f and g meet at the dihedral theta with  cos theta = -n_f . n_g.
  double smallestCosine = 1, largestCosine = -1;
  for (const auto& [f, g] : kTetEdges) {
    const double cosine = -normal[f].dot(normal[g]);
    smallestCosine = std::min(smallestCosine, cosine);
    largestCosine = std::max(largestCosine, cosine);
  }
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  const bool flat = std::abs(volume) <= kFlatness * longestEdge * longestEdge * longestEdge;
  // The shortest altitude stands on the largest face:  V = A h / 3.
  return {.aspectRatio = flat ? kInfinity : longestEdge * largestArea / (3 * std::abs(volume)),
          .minDihedralDeg = degrees(largestCosine),
          .maxDihedralDeg = degrees(smallestCosine),
          .volume = volume};
}

/// What a range of tets adds to the quality of the mesh.
struct Tally {
  double maxAspectRatio = 0, sumAspectRatio = 0;
  double minDihedralDeg = 180, maxDihedralDeg = 0;
  double shortestSquared = kInfinity, longestSquared = 0;
  double volume = 0;
  std::int64_t inverted = 0, finite = 0, worstTet = -1;

  void add(std::int64_t tet, const std::array<Eigen::Vector3d, 4>& x) {
    const EdgeRange squared = squaredEdges(x);
    const TetQuality quality = qualityOf(x, std::sqrt(squared.longest));
    const bool isFinite = std::isfinite(quality.aspectRatio);
    merge({.maxAspectRatio = quality.aspectRatio,
           .sumAspectRatio = isFinite ? quality.aspectRatio : 0,
           .minDihedralDeg = quality.minDihedralDeg,
           .maxDihedralDeg = quality.maxDihedralDeg,
           .shortestSquared = squared.shortest,
           .longestSquared = squared.longest,
           .volume = quality.volume,
           .inverted = quality.volume <= 0,
           .finite = isFinite,
           .worstTet = tet});
  }

  /// `right` holds later tets: the first of equally bad ones stays the worst.
  void merge(const Tally& right) {
    if (right.maxAspectRatio > maxAspectRatio) worstTet = right.worstTet;
    maxAspectRatio = std::max(maxAspectRatio, right.maxAspectRatio);
    sumAspectRatio += right.sumAspectRatio;
    minDihedralDeg = std::min(minDihedralDeg, right.minDihedralDeg);
    maxDihedralDeg = std::max(maxDihedralDeg, right.maxDihedralDeg);
    shortestSquared = std::min(shortestSquared, right.shortestSquared);
    longestSquared = std::max(longestSquared, right.longestSquared);
    volume += right.volume;
    inverted += right.inverted;
    finite += right.finite;
  }
};

Tally tallyOf(const TetMesh& mesh) {
  const auto addRange = [&](const tbb::blocked_range<std::size_t>& range, Tally tally) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const auto& [a, b, c, d] = mesh.tets[t];
      tally.add(static_cast<std::int64_t>(t), {mesh.nodes[a], mesh.nodes[b], mesh.nodes[c], mesh.nodes[d]});
    }
    return tally;
  };
  const auto join = [](Tally left, const Tally& right) {
    left.merge(right);
    return left;
  };
  const tbb::blocked_range<std::size_t> all(0, mesh.tets.size(), kGrain);
  return tbb::parallel_deterministic_reduce(all, Tally{}, addRange, join);
}

}  // namespace

TetQuality tetQuality(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  const std::array<Eigen::Vector3d, 4> x{a, b, c, d};
  return qualityOf(x, std::sqrt(squaredEdges(x).longest));
}

MeshQuality meshQuality(const TetMesh& mesh) {
  MeshQuality quality{.tets = std::ssize(mesh.tets), .nodes = std::ssize(mesh.nodes)};
  if (mesh.tets.empty()) return quality;
  const Tally tally = tallyOf(mesh);
  quality.maxAspectRatio = tally.maxAspectRatio;
  quality.meanAspectRatio =
      tally.finite > 0 ? tally.sumAspectRatio / static_cast<double>(tally.finite) : kInfinity;
  quality.minDihedralDeg = tally.minDihedralDeg;
  quality.maxDihedralDeg = tally.maxDihedralDeg;
  quality.maxOverMinEdge = std::sqrt(tally.longestSquared / tally.shortestSquared);
  quality.volume = tally.volume;
  quality.inverted = tally.inverted;
  quality.worstTet = tally.worstTet;
  return quality;
}

}  // namespace sinew
