#include "sinew/Mesher/Sizing.h"

#include "Parallel.h"
#include "sinew/Mesher/Curvature.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sinew {
namespace {

constexpr double kTetRadius = 0.56;       // sqrt(5)/4: circumradius of a BCC tet over its cube size
constexpr double kCubeRadius = 0.867;     // sqrt(3)/2: half the diagonal of a cube
constexpr double kSurfaceLayer = 1.0;     // edge lengths on either side of the surface that are uniform
constexpr double kLipschitzSlack = 1.05;  // a sampled distance may grow a little faster than the distance
constexpr double kThinDepth = 0.6;        // of one cube size: phi one cube below the surface is no deeper
constexpr int kDepthSamples = 4;          // on the way through a part that may be thin
constexpr double kWholesale = 0.15;       // of the surface asks for finer tets: then all of it gets them
constexpr int kMostFiner = 8;             // levels below the surface's
constexpr int kMargin = 3;  // cubes of level 0 around the bounds: two that overhang, one that stays whole

/// Level -> cubes of that level that may hold tets within the layer around the surface.
class NearCubes {
 public:
  NearCubes(const LatticePlan& plan, const SignedDistance& phi, double layer) : plan_(plan) {
    base_ = 0;
    while (base_ < plan.surfaceLevel + kBeyondSurfaceLevel && reach(base_, layer) > phi.band()) ++base_;
    flags_.resize(base_ + 1);
    fillBase(phi, layer);
    for (int level = base_; level > 0; --level) fillCoarser(level);
  }
  /// Levels 0 .. base() are decided here; on finer ones phi at the centre of a tet tells.
  int base() const { return base_; }

  /// Whether one of the two cubes that share the tet is near.
  bool near(int level, const BccTet& tet) const {
    const std::array<Int3, 4> nodes = bccNodes(tet);
    // The tet lies in the two cubes whose centres are its odd nodes.
    return at(level, {nodes[2].x >> 1, nodes[2].y >> 1, nodes[2].z >> 1}) ||
           at(level, {nodes[3].x >> 1, nodes[3].y >> 1, nodes[3].z >> 1});
  }

 private:
  /// Cubes below the surface level need not be in the lattice; they only sample phi more finely.
  static constexpr int kBeyondSurfaceLevel = 1;

  double cubeSize(int level) const { return std::ldexp(plan_.cubeSize(0), -level); }
  double reach(int level, double layer) const {
    return kLipschitzSlack * (kCubeRadius * cubeSize(level) + layer);
  }
  Int3 cells(int level) const { return plan_.coarseCells << level; }
  std::size_t index(int level, Int3 c) const {
    const Int3 n = cells(level);
    return (static_cast<std::size_t>(c.z) * n.y + c.y) * n.x + c.x;
  }
  bool at(int level, Int3 c) const { return flags_[level][index(level, c)] != 0; }

  void fillBase(const SignedDistance& phi, double layer) {
    const Int3 n = cells(base_);
    flags_[base_].assign(static_cast<std::size_t>(n.x) * n.y * n.z, 0);
    const double size = cubeSize(base_), near = reach(base_, layer);
    // The surface lies within the bounds of phi.
    const Eigen::Array3d below = (phi.bounds().min() - plan_.frame.origin).array() - near,
                         above = (phi.bounds().max() - plan_.frame.origin).array() + near;
    const Eigen::Array3i first = (below / size - 0.5).ceil().max(0).cast<int>(),
                         last =
                             (above / size - 0.5).floor().cast<int>().min(Eigen::Array3i(n.x, n.y, n.z) - 1);
    tbb::parallel_for(first.z(), last.z() + 1, [&](int z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
          const Eigen::Vector3d centre =
              plan_.frame.origin + size * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
          flags_[base_][index(base_, {x, y, z})] = std::abs(phi.value(centre)) <= near;
        }
      }
    });
  }

  void fillCoarser(int level) {
    const Int3 n = cells(level - 1);
    flags_[level - 1].assign(static_cast<std::size_t>(n.x) * n.y * n.z, 0);
    tbb::parallel_for(0, n.z, [&](int z) {
      for (int y = 0; y < 2 * n.y; ++y) {
        for (int x = 0; x < 2 * n.x; ++x)
          flags_[level - 1][index(level - 1, {x / 2, y / 2, z})] |=
              flags_[level][index(level, {x, y, 2 * z})] | flags_[level][index(level, {x, y, 2 * z + 1})];
      }
    });
  }

  const LatticePlan& plan_;
  int base_ = 0;
  std::vector<std::vector<std::uint8_t>> flags_;
};

/// What a pass over the lattice asks for.
struct Wishes {
  std::vector<LevelTet> tets;  ///< to be refined, coarse to fine along every branch
  int finest = 0;              ///< level that this takes
  std::int64_t surface = 0;    ///< tets of the surface level that the surface passes
  std::int64_t finer = 0;      ///< those of them that the rules want finer
  bool mostFiner() const { return static_cast<double>(finer) > kWholesale * static_cast<double>(surface); }
};

/// Decides tet by tet, from level 0 downwards.
class Refiner {
 public:
  Refiner(const LatticePlan& plan, const SignedDistance& phi, const SizingOptions& options)
      : plan_(plan),
        phi_(phi),
        options_(options),
        layer_(kSurfaceLayer * plan.cubeSize(plan.surfaceLevel)),
        nearCubes_(plan, phi, layer_) {}

  /// Notes the tets to be refined below a tet, itself included.
  void collect(int level, const BccTet& tet, Wishes& wishes) const {
    if (level + 1 >= plan_.levels || !wants(level, tet, wishes)) return;
    wishes.tets.push_back({level, tet});
    wishes.finest = std::max(wishes.finest, level + 1);
    for (const BccTet& child : redChildren(tet)) collect(level + 1, child, wishes);
  }

 private:
  bool wants(int level, const BccTet& tet, Wishes& wishes) const {
    if (level <= nearCubes_.base() && !nearCubes_.near(level, tet)) return false;
    const double cube = plan_.cubeSize(level);
    const Eigen::Vector3d centre = centreOf(level, tet);
    const double phi = phi_.value(centre);
    if (level < plan_.surfaceLevel) {
      if (level < nearCubes_.base()) return true;
      return std::abs(phi) <= kLipschitzSlack * (kTetRadius * cube + layer_);
    }
    if (std::abs(phi) > kLipschitzSlack * kTetRadius * cube) return false;
    if (0.5 * cube < options_.minEdgeLength * (1 - 1e-9)) return false;
    const bool finer = tooCoarse(cube, centre, phi);
    if (level == plan_.surfaceLevel) {
      ++wishes.surface;
      wishes.finer += finer;
    }
    return finer;
  }

  /// Curvature, tolerance and thickness at the point of the surface below the centre of a tet.
  bool tooCoarse(double cube, const Eigen::Vector3d& centre, double phi) const {
    Eigen::Vector3d gradient;
    phi_.valueAndGradient(centre, gradient);
    const double norm = gradient.norm();
    if (norm < 1e-6) return options_.thickness > 0;  // on a medial sheet this close to the surface
    const Eigen::Vector3d normal = gradient / norm;
    const Eigen::Vector3d foot = centre - phi * normal;
    // Smaller cubes than the samples would follow nothing but the corners of the interpolant.
    const bool belowResolution = 0.5 * cube < phi_.resolution() * (1 - 1e-9);
    if (options_.thickness > 0 && (belowResolution ? ends(cube, foot, normal) : thin(cube, foot, normal)))
      return true;
    if (belowResolution || (options_.curvature <= 0 && options_.tolerance <= 0)) return false;
    if (options_.curvature > 0 &&
        cube * principalCurvatures(phi_, foot, phi_.resolution()).magnitude() > options_.curvature)
      return true;
    return options_.tolerance > 0 && sag(cube, foot, normal) > options_.tolerance;
  }

  /// Whether the shape is not as deep below a point of its surface as where it is `thickness` cubes thick.
  bool thin(double cube, const Eigen::Vector3d& foot, const Eigen::Vector3d& normal) const {
    const double depth = (options_.thickness - kThinDepth) * cube;
    return phi_.value(foot - depth * normal) > -kThinDepth * cube;
  }

  /// Whether the shape ends within `thickness` cubes below a point of its surface: a ridge, which is thin as
  /// well, does not.
  bool ends(double cube, const Eigen::Vector3d& foot, const Eigen::Vector3d& normal) const {
    for (int k = 1; k <= kDepthSamples; ++k) {
      const double depth = options_.thickness * cube * k / kDepthSamples;
      if (phi_.value(foot - depth * normal) > 0) return true;
    }
    return false;
  }

  /// How far an edge of length h leaves the surface, h^2 k / 8 for the larger principal curvature k: half the
  /// second difference of phi over the edge in the tangent plane. Ripples that are shorter add their height
  /// only.
  double sag(double h, const Eigen::Vector3d& foot, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    const double phi = phi_.value(foot);
    const auto along = [&](const Eigen::Vector3d& t) {
      return (phi_.value(foot + 0.5 * h * t) + phi_.value(foot - 0.5 * h * t)) / 2 - phi;
    };
    const double a = along(u), c = along(v), b = along((u + v) * std::sqrt(0.5)) - (a + c) / 2;
    return std::abs(a + c) / 2 + std::hypot((a - c) / 2, b);
  }

  Eigen::Vector3d centreOf(int level, const BccTet& tet) const {
    const std::array<Int3, 4> nodes = bccNodes(tet);
    const Int3 sum = (nodes[0] + nodes[1] + nodes[2] + nodes[3]) << (plan_.levels - 1 - level);
    return plan_.frame.origin + 0.25 * plan_.frame.halfCube * Eigen::Vector3d(sum.x, sum.y, sum.z);
  }

  const LatticePlan& plan_;
  const SignedDistance& phi_;
  const SizingOptions& options_;
  double layer_;
  NearCubes nearCubes_;
};

}  // namespace

LatticePlan planLattice(const SignedDistance& phi, const SizingOptions& options) {
  int coarser = 0, finer = 0;
  // A cube larger than the shape buys nothing.
  const double largest = std::min(options.maxEdgeLength, phi.bounds().sizes().maxCoeff()) * (1 + 1e-9);
  while (std::ldexp(options.edgeLength, coarser + 1) <= largest) ++coarser;
  while (std::ldexp(options.edgeLength, -finer - 1) >= options.minEdgeLength * (1 - 1e-9) &&
         finer < kMostFiner)
    ++finer;
  if (options.curvature <= 0 && options.tolerance <= 0 && options.thickness <= 0) finer = 0;
  if (options.levels > 0) {
    coarser = std::min(coarser, options.levels - 1);
    finer = std::min(finer, options.levels - 1 - coarser);
  }

  LatticePlan plan;
  plan.levels = coarser + 1 + finer;
  plan.surfaceLevel = coarser;
  plan.frame.halfCube = 0.5 * options.edgeLength / (1 << finer);
  const double coarse = options.edgeLength * (1 << coarser);
  const Eigen::AlignedBox3d box = phi.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const int cells = static_cast<int>(std::ceil(box.sizes()[axis] / coarse)) + 2 * kMargin;
    plan.coarseCells[axis] = cells;
    plan.frame.origin[axis] = box.center()[axis] - 0.5 * coarse * cells;
  }
  return plan;
}

namespace {

Wishes collectWishes(const LatticePlan& plan, const SignedDistance& phi, const SizingOptions& options) {
  const Refiner refiner(plan, phi, options);
  const Int3 n = plan.coarseCells;
  std::vector<Wishes> layers(n.z);
  tbb::parallel_for(1, n.z - 1, [&](int z) {
    for (int y = 1; y < n.y - 1; ++y) {
      for (int x = 1; x < n.x - 1; ++x) {
        for (const BccTet& tet : RedGreenLattice::coarseTets({x, y, z})) refiner.collect(0, tet, layers[z]);
      }
    }
  });
  Wishes all;
  std::vector<std::vector<LevelTet>> tets;
  for (Wishes& layer : layers) {
    tets.push_back(std::move(layer.tets));
    all.finest = std::max(all.finest, layer.finest);
    all.surface += layer.surface;
    all.finer += layer.finer;
  }
  all.tets = concatenated(std::move(tets));
  return all;
}

}  // namespace

int refineToSize(RedGreenLattice& lattice, LatticePlan& plan, const SignedDistance& phi,
                 const SizingOptions& options) {
  Wishes wishes = collectWishes(plan, phi, options);
  while (wishes.mostFiner()) {
    ++plan.surfaceLevel;
    wishes = collectWishes(plan, phi, options);
  }
  lattice.refine(wishes.tets);
  lattice.close();
  return wishes.finest;
}

}  // namespace sinew
