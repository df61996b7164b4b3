#include "sinew/Mesher/MeshQuality.h"

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace sinew {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// |V| / (longest edge)^3 up to which a tet counts as flat: its volume is rounding.
constexpr double kFlatness = 1e-12;

/// Tets per task; fixed, because it decides the order of the sums.
constexpr std::size_t kTetGrain = 4096;

double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

/// Squared lengths of the six edges, shortest and longest.
struct EdgeRange {
  double shortest = kUnbounded;
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

/// What the four faces of a tet tell.
struct Faces {
  std::array<double, 6> cosines;  ///< of the dihedral angles, as in dihedralAnglesDeg
  double largestArea = 0;
};

Faces facesOf(const std::array<Eigen::Vector3d, 4>& x) {
  Faces faces;
  std::array<Eigen::Vector3d, 4> normal;
  for (int f = 0; f < 4; ++f) {
    const auto& [i, j, k] = kTetFaces[f];
    const Eigen::Vector3d n = (x[j] - x[i]).cross(x[k] - x[i]);
    const double length = n.norm();
    faces.largestArea = std::max(faces.largestArea, length / 2);
    normal[f] = n / std::max(length, std::numeric_limits<double>::min());
  }
  // Faces f and g meet at the dihedral theta with  cos theta = -n_f . n_g.
  for (int e = 0; e < 6; ++e) {
    const auto& [f, g] = kTetEdges[e];
    faces.cosines[e] = -normal[f].dot(normal[g]);
  }
  return faces;
}

TetQuality qualityOf(const std::array<Eigen::Vector3d, 4>& x, double longestEdge) {
  const Faces faces = facesOf(x);
  const auto [smallestCosine, largestCosine] =
      std::minmax_element(faces.cosines.begin(), faces.cosines.end());
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  const bool flat = std::abs(volume) <= kFlatness * longestEdge * longestEdge * longestEdge;
  // The shortest altitude stands on the largest face:  V = A h / 3.
  return {.aspectRatio = flat ? kUnbounded : longestEdge * faces.largestArea / (3 * std::abs(volume)),
          .minDihedralDeg = degrees(*largestCosine),
          .maxDihedralDeg = degrees(*smallestCosine),
          .volume = volume};
}

/// The kRankedTets worst of the tets that were added in the order of the mesh.
template <class Worse>
class Ranking {
 public:
  void add(const RankedTet& tet) {
    const Worse worse;
    if (count_ == kRankedTets && !worse(tet.value, tets_.back().value)) return;
    std::size_t place = std::min(count_, kRankedTets - 1);
    for (; place > 0 && worse(tet.value, tets_[place - 1].value); --place) tets_[place] = tets_[place - 1];
    tets_[place] = tet;
    count_ = std::min(count_ + 1, kRankedTets);
  }
  void add(const Ranking& later) {
    for (std::size_t i = 0; i < later.count_; ++i) add(later.tets_[i]);
  }
  std::vector<RankedTet> list() const { return {tets_.begin(), tets_.begin() + std::ptrdiff_t(count_)}; }

 private:
  std::array<RankedTet, kRankedTets> tets_;
  std::size_t count_ = 0;
};

/// What a range of tets adds to the quality of the mesh.
struct Tally {
  double maxAspectRatio = 0, sumAspectRatio = 0;
  double minDihedralDeg = 180, maxDihedralDeg = 0;
  double shortestSquared = kUnbounded, longestSquared = 0;
  double volume = 0;
  std::int64_t inverted = 0, finite = 0;
  Ranking<std::greater<>> aspectRatios, largestDihedrals;
  Ranking<std::less<>> smallestDihedrals;

  void add(std::int64_t tet, const std::array<Eigen::Vector3d, 4>& x) {
    const EdgeRange squared = squaredEdges(x);
    const TetQuality quality = qualityOf(x, std::sqrt(squared.longest));
    const bool isFinite = std::isfinite(quality.aspectRatio);
    maxAspectRatio = std::max(maxAspectRatio, quality.aspectRatio);
    sumAspectRatio += isFinite ? quality.aspectRatio : 0;
    minDihedralDeg = std::min(minDihedralDeg, quality.minDihedralDeg);
    maxDihedralDeg = std::max(maxDihedralDeg, quality.maxDihedralDeg);
    shortestSquared = std::min(shortestSquared, squared.shortest);
    longestSquared = std::max(longestSquared, squared.longest);
    volume += quality.volume;
    inverted += quality.volume <= 0;
    finite += isFinite;
    aspectRatios.add({tet, quality.aspectRatio});
    smallestDihedrals.add({tet, quality.minDihedralDeg});
    largestDihedrals.add({tet, quality.maxDihedralDeg});
  }

  /// @param right  of later tets
  void merge(const Tally& right) {
    maxAspectRatio = std::max(maxAspectRatio, right.maxAspectRatio);
    sumAspectRatio += right.sumAspectRatio;
    minDihedralDeg = std::min(minDihedralDeg, right.minDihedralDeg);
    maxDihedralDeg = std::max(maxDihedralDeg, right.maxDihedralDeg);
    shortestSquared = std::min(shortestSquared, right.shortestSquared);
    longestSquared = std::max(longestSquared, right.longestSquared);
    volume += right.volume;
    inverted += right.inverted;
    finite += right.finite;
    aspectRatios.add(right.aspectRatios);
    smallestDihedrals.add(right.smallestDihedrals);
    largestDihedrals.add(right.largestDihedrals);
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
  const tbb::blocked_range<std::size_t> all(0, mesh.tets.size(), kTetGrain);
  return tbb::parallel_deterministic_reduce(all, Tally{}, addRange, join);
}

}  // namespace

TetQuality tetQuality(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  const std::array<Eigen::Vector3d, 4> x{a, b, c, d};
  return qualityOf(x, std::sqrt(squaredEdges(x).longest));
}

std::array<double, 6> dihedralAnglesDeg(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  std::array<double, 6> angles = facesOf({a, b, c, d}).cosines;
  std::transform(angles.begin(), angles.end(), angles.begin(), degrees);
  return angles;
}

MeshQuality meshQuality(const TetMesh& mesh) {
  MeshQuality quality;
  quality.tets = std::ssize(mesh.tets);
  quality.nodes = std::ssize(mesh.nodes);
  if (mesh.tets.empty()) return quality;
  const Tally tally = tallyOf(mesh);
  quality.maxAspectRatio = tally.maxAspectRatio;
  quality.meanAspectRatio =
      tally.finite > 0 ? tally.sumAspectRatio / static_cast<double>(tally.finite) : kUnbounded;
  quality.minDihedralDeg = tally.minDihedralDeg;
  quality.maxDihedralDeg = tally.maxDihedralDeg;
  quality.maxOverMinEdge = std::sqrt(tally.longestSquared / tally.shortestSquared);
  quality.volume = tally.volume;
  quality.inverted = tally.inverted;
  quality.largestAspectRatios = tally.aspectRatios.list();
  quality.smallestDihedrals = tally.smallestDihedrals.list();
  quality.largestDihedrals = tally.largestDihedrals.list();
  return quality;
}

}  // namespace sinew
