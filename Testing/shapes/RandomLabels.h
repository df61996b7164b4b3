#pragma once

#include "sinew/Segmentation/Segmentation.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <array>

namespace sinew::test {

/// What is drawn.
struct Drawing {
  const char* name;
  int kind;     ///< of ShapeMaker; or one of the following, which only voxels can show
  bool cut;     ///< by the edge of the scan
  bool simple;  ///< one voxel thick or thicker and without holes: the mesh has its topology
};
inline constexpr int kVoxelBridge = ShapeMaker::kKinds, kTouchingBlocks = kVoxelBridge + 1;
inline constexpr std::array<Drawing, 11> kDrawings{{{"blended spheres", 0, false, false},
                                                    {"torus", 1, false, false},
                                                    {"gyroid piece", 2, false, false},
                                                    {"box", 5, false, true},
                                                    {"thin plate", 6, false, true},
                                                    {"thin rod", 7, false, false},
                                                    {"bridge of one voxel", kVoxelBridge, false, false},
                                                    {"blocks that touch", kTouchingBlocks, false, false},
                                                    {"blended spheres, cut", 0, true, false},
                                                    {"gyroid piece, cut", 2, true, false},
                                                    {"thin plate, cut", 6, true, true}}};

/// A random tissue as voxels of a scan.
struct RandomLabels {
  Drawing drawing;
  Segmentation segmentation;  ///< one tissue
};

/// A way to scan: spacing in mm, for shapes of about 10 mm, and the turn of the scan's axes.
struct Scan {
  Eigen::Vector3d spacing;
  double tiltDeg;
};
inline const std::array<Scan, 4> kScans{
    {{{0.4, 0.4, 0.4}, 0}, {{0.7, 0.7, 0.7}, 25}, {{0.3, 0.3, 0.9}, 0}, {{0.4, 0.5, 0.6}, 40}}};

class RandomScan {
 public:
  explicit RandomScan(unsigned seed)
      : seed_(seed), drawing_(kDrawings[seed % kDrawings.size()]), scan_(kScans[seed % kScans.size()]) {}

  RandomLabels make() {
    RandomLabels labels{drawing_, {}};
    Segmentation& s = labels.segmentation;
    s.source = drawing_.name;
    s.geometry.spacing = scan_.spacing;
    s.geometry.direction =
        Eigen::AngleAxisd(scan_.tiltDeg * std::numbers::pi / 180, Eigen::Vector3d(3, 2, 1).normalized())
            .toRotationMatrix();
    if (drawing_.kind < ShapeMaker::kKinds)
      drawField(s);
    else
      drawBlocks(s);
    updateTissueTable(s);
    return labels;
  }

 private:
  /// The voxels whose centres lie in a random shape; a scan that cuts covers more than half of it along every
  /// axis.
  void drawField(Segmentation& s) const {
    const RandomShape shape = ShapeMaker(seed_).make(drawing_.kind, {});
    const Eigen::AlignedBox3d box = shape.bounds();
    const double reach = 0.5 * box.sizes().x();
    const double shown = drawing_.cut ? 1.5 : 2.6;  // of the reach, along every axis
    s.geometry.size = (shown * reach / s.geometry.spacing.array()).cast<int>();
    s.geometry.origin = box.center() - 1.3 * reach * s.geometry.direction * Eigen::Vector3d::Ones();
    const Eigen::Affine3d toPhysical = s.geometry.indexToPhysical();
    draw(s, [&](const Eigen::Vector3i& i) { return shape.value(toPhysical * i.cast<double>()) < 0; });
  }

  /// Two blocks of some voxels: apart, with a row of single voxels between them, or with a face, an edge or a
  /// corner in common.
  void drawBlocks(Segmentation& s) {
    s.geometry.size = {30, 20, 20};
    const Eigen::Vector3i a(5, 6, 6), aSize = blockSize(), bSize = blockSize();
    const bool bridge = drawing_.kind == kVoxelBridge;
    const Eigen::Vector3i end = a + aSize;
    const int common = below(3);  // 0: a face, 1: an edge, 2: a corner
    Eigen::Vector3i b(end.x(), common > 0 ? end.y() : a.y(), common > 1 ? end.z() : a.z());
    if (bridge) b = {end.x() + 2 + below(4), a.y(), a.z()};
    const auto in = [](const Eigen::Vector3i& i, const Eigen::Vector3i& low, const Eigen::Vector3i& size) {
      return (i.array() >= low.array()).all() && (i.array() < (low + size).array()).all();
    };
    const Eigen::Vector3i row(a.x(), a.y() + 1, a.z() + 1), rowSize(b.x() - a.x(), 1, 1);
    draw(s, [&](const Eigen::Vector3i& i) {
      return in(i, a, aSize) || in(i, b, bSize) || (bridge && in(i, row, rowSize));
    });
  }

  template <class Inside>
  static void draw(Segmentation& s, Inside inside) {
    std::vector<std::int32_t>& voxels = s.layers.emplace_back();
    const Eigen::Vector3i& n = s.geometry.size;
    for (int k = 0; k < n.z(); ++k)
      for (int j = 0; j < n.y(); ++j)
        for (int i = 0; i < n.x(); ++i) voxels.push_back(inside(Eigen::Vector3i(i, j, k)) ? 1 : 0);
  }

  Eigen::Vector3i blockSize() {
    const int x = 4 + below(5), y = 3 + below(5);
    return {x, y, 3 + below(5)};
  }
  int below(unsigned count) { return static_cast<int>(random_() % count); }

  unsigned seed_;
  Drawing drawing_;
  Scan scan_;
  std::mt19937 random_{seed_};
};

}  // namespace sinew::test
