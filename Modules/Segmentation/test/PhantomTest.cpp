#include "sinew/Segmentation/LabelComponents.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using std::numbers::pi;

const Tissue& tissueNamed(const Segmentation& image, const std::string& name) {
  const auto found = std::ranges::find(image.tissues, name, &Tissue::name);
  if (found == image.tissues.end()) throw std::out_of_range(name);
  return *found;
}

double volumeOf(const Segmentation& image, const std::string& name) {
  return static_cast<double>(tissueNamed(image, name).voxels) * image.geometry.voxelVolume();
}

std::size_t piecesOf(const Segmentation& image, const std::string& name) {
  return labelComponents(image, tissueNamed(image, name)).voxels.size();
}

/// The labels of the up to six face neighbours of a voxel.
struct Neighbours {
  std::array<std::int32_t, 6> labels{};
  int count = 0;

  bool have(std::int32_t label) const {
    return std::count(labels.begin(), labels.begin() + count, label) > 0;
  }
  bool differFrom(std::int32_t label) const {
    return std::count(labels.begin(), labels.begin() + count, label) < count;
  }
};

Neighbours neighboursOf(const Segmentation& image, const Vector3i& at) {
  Neighbours found;
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      Vector3i next = at;
      next[axis] += step;
      if (next[axis] >= 0 && next[axis] < image.geometry.size[axis])
        found.labels[found.count++] = image.at(0, next);
    }
  return found;
}

/// Calls visit(index, label) for every voxel.
template <class Visit>
void forEachVoxel(const Segmentation& image, const Visit& visit) {
  const Vector3i size = image.geometry.size;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) visit(Vector3i(i, j, k), image.at(0, {i, j, k}));
}

/// Made once: it is the large one.
const Segmentation& upperArm() {
  static const Segmentation arm = makePhantom("upper-arm");
  return arm;
}

Vector3d centroidOf(const Segmentation& image, const std::string& name) {
  const std::int32_t label = tissueNamed(image, name).label;
  Vector3d sum = Vector3d::Zero();
  forEachVoxel(image, [&](const Vector3i& at, std::int32_t value) {
    if (value == label) sum += image.geometry.indexToPhysical() * at.cast<double>();
  });
  return sum / static_cast<double>(tissueNamed(image, name).voxels);
}

/// Standard deviation of a sampled volume: the voxels that the surface cuts, one half-voxel lot each, are few
/// of n.
double samplingError(double area, const Segmentation& image) {
  const double h = image.geometry.meanSpacing();
  return std::sqrt(area / (h * h)) * h * h * h;
}

TEST(Phantom, EveryOneNamesItsTissuesAndLeavesAFreeBorder) {
  ASSERT_EQ(phantoms().size(), 10u);
  for (const PhantomInfo& info : phantoms()) {
    SCOPED_TRACE(info.name);
    EXPECT_FALSE(info.description.empty());
    const Segmentation image = info.name == "upper-arm" ? upperArm() : makePhantom(info.name);
    ASSERT_EQ(image.layers.size(), info.name == "overlapping-muscles" ? 2u : 1u);
    EXPECT_EQ(std::ssize(image.layers[0]), image.geometry.voxelCount());
    EXPECT_FALSE(image.tissues.empty());
    EXPECT_TRUE(image.emptyTissues.empty());
    for (const Tissue& tissue : image.tissues) {
      EXPECT_TRUE(tissue.named) << tissue.name;
      EXPECT_GT(tissue.box.lower.minCoeff(), 0) << tissue.name;
      EXPECT_LT((tissue.box.upper - image.geometry.size).maxCoeff(), 0) << tissue.name;
    }
  }
}

TEST(Phantom, SphereAndTorusHaveTheirVolume) {
  const Segmentation sphere = makePhantom("sphere");
  EXPECT_NEAR(volumeOf(sphere, "sphere"), 4 * pi / 3 * 8000, 3 * samplingError(4 * pi * 400, sphere));
  const Segmentation torus = makePhantom("torus");
  EXPECT_NEAR(volumeOf(torus, "torus"), 2 * pi * pi * 20 * 64,
              3 * samplingError(4 * pi * pi * 20 * 8, torus));
}

TEST(Phantom, NestedShellsHaveTheirVolumes) {
  const Segmentation nested = makePhantom("nested");
  const std::array<double, 5> radii{0, 8, 14, 20, 26};
  const std::array<const char*, 4> names{"core", "inner shell", "middle shell", "outer shell"};
  for (int s = 0; s < 4; ++s) {
    const double inner = radii[s], outer = radii[s + 1];
    const double volume = 4 * pi / 3 * (outer * outer * outer - inner * inner * inner);
    EXPECT_NEAR(volumeOf(nested, names[s]), volume,
                3 * samplingError(4 * pi * (outer * outer + inner * inner), nested));
    EXPECT_EQ(piecesOf(nested, names[s]), 1u);
  }
}

TEST(Phantom, SpacingAndTiltChangeTheScanAndNotTheShape) {
  const double exact = 2 * pi * pi * 20 * 64, area = 4 * pi * pi * 20 * 8;
  const Segmentation scan = makePhantom("torus", {.spacing = Vector3d(0.7, 0.9, 2.1), .tiltDeg = 33});
  EXPECT_EQ(scan.geometry.spacing, Vector3d(0.7, 0.9, 2.1));
  // A turn by the angle a has the trace 1 + 2 cos a and the determinant 1.
  EXPECT_NEAR(scan.geometry.direction.trace(), 1 + 2 * std::cos(33 * pi / 180), 1e-12);
  EXPECT_NEAR(scan.geometry.direction.determinant(), 1, 1e-12);
  EXPECT_NEAR(volumeOf(scan, "torus"), exact, 3 * samplingError(area, scan));
  EXPECT_LT(centroidOf(scan, "torus").norm(), 0.1);  // mm; about the origin whatever the axes
  EXPECT_GT(std::abs(scan.geometry.direction(0, 1)), 0.01);
  EXPECT_GT(std::abs(scan.geometry.direction(0, 2)), 0.01);
  EXPECT_GT(std::abs(scan.geometry.direction(1, 2)), 0.01);  // oblique about no axis
}

TEST(Phantom, ThinHasExactlyTheStatedVoxels) {
  const Segmentation thin = makePhantom("thin");
  ASSERT_EQ(thin.tissues.size(), 8u);
  for (int n = 1; n <= 4; ++n) {
    const std::string voxels = std::to_string(n) + (n == 1 ? " voxel" : " voxels");
    const Tissue& plate = tissueNamed(thin, "plate " + voxels);
    EXPECT_EQ(plate.box.upper - plate.box.lower, Vector3i(30, 30, n));
    EXPECT_EQ(plate.voxels, 30 * 30 * n);
    EXPECT_EQ(piecesOf(thin, "plate " + voxels), 1u);
    const Tissue& tube = tissueNamed(thin, "tube " + voxels);
    EXPECT_EQ(tube.box.upper - tube.box.lower, Vector3i(10 + 2 * n, 10 + 2 * n, 28));
    EXPECT_EQ(piecesOf(thin, "tube " + voxels), 1u);
    // Along the axes through the lumen the wall has n voxels on either side.
    const int k = tube.box.lower.z() + 10, j = (tube.box.lower.y() + tube.box.upper.y()) / 2;
    int inRow = 0;
    for (int i = tube.box.lower.x(); i < tube.box.upper.x(); ++i)
      inRow += thin.at(0, {i, j, k}) == tube.label;
    EXPECT_EQ(inRow, 2 * n);
  }
}

TEST(Phantom, UpperArmIsAnatomicallyInOrder) {
  const Segmentation& arm = upperArm();
  EXPECT_EQ(arm.geometry.spacing, Vector3d(0.5, 0.5, 2));
  const double side = std::cbrt(static_cast<double>(arm.geometry.voxelCount()));
  EXPECT_GT(side, 80);
  EXPECT_LT(side, 125);
  const std::map<std::string, std::size_t> pieces{
      {"humerus", 1}, {"biceps", 1}, {"biceps tendons", 3}, {"triceps", 1}, {"triceps tendons", 2},
      {"fat", 1},     {"skin", 1}};
  ASSERT_EQ(arm.tissues.size(), pieces.size());
  for (const auto& [name, count] : pieces) EXPECT_EQ(piecesOf(arm, name), count) << name;
  // In LPS, y grows to the back.
  EXPECT_LT(centroidOf(arm, "biceps").y(), centroidOf(arm, "humerus").y());
  EXPECT_GT(centroidOf(arm, "triceps").y(), centroidOf(arm, "humerus").y());
}

TEST(Phantom, SkinClosesTheArm) {
  const Segmentation& arm = upperArm();
  const std::int32_t skin = tissueNamed(arm, "skin").label;
  std::int64_t bare = 0;
  forEachVoxel(arm, [&](const Vector3i& at, std::int32_t label) {
    if (label != 0 && label != skin) bare += neighboursOf(arm, at).have(0);
  });
  EXPECT_EQ(bare, 0);
}

TEST(Phantom, TheHumerusFlaresAtBothEnds) {
  const Segmentation arm = makePhantom("upper-arm", {.spacing = Vector3d(1, 1, 2), .tiltDeg = 0});
  const std::int32_t humerus = tissueNamed(arm, "humerus").label;
  std::map<int, std::int64_t> areaAt;  // voxels by slice height, mm
  forEachVoxel(arm, [&](const Vector3i& at, std::int32_t label) {
    if (label == humerus)
      ++areaAt[int(std::lround((arm.geometry.indexToPhysical() * at.cast<double>()).z()))];
  });
  EXPECT_GT(areaAt.at(-65), 3 * areaAt.at(1) / 2);
  EXPECT_GT(areaAt.at(61), 2 * areaAt.at(1));
}

TEST(Phantom, NoiseStaysAtTheSurfaceAndInProportion) {
  const Segmentation clean = makePhantom("nested");
  const Segmentation noisy = makePhantom("nested", {.noise = 0.3});
  std::int64_t surface = 0, flipped = 0;
  forEachVoxel(clean, [&](const Vector3i& at, std::int32_t label) {
    const Neighbours neighbours = neighboursOf(clean, at);
    const bool onSurface = neighbours.differFrom(label);
    const std::int32_t now = noisy.at(0, at);
    surface += onSurface;
    flipped += now != label;
    EXPECT_TRUE(now == label || neighbours.have(now));
  });
  // A binomial lot: five standard deviations.
  EXPECT_NEAR(double(flipped), 0.3 * double(surface), 5 * std::sqrt(0.3 * 0.7 * double(surface)));
}

TEST(Phantom, FullNoiseFlipsEverySurfaceVoxel) {
  const Segmentation clean = makePhantom("sphere", {.spacing = Vector3d::Constant(4)});
  const Segmentation noisy = makePhantom("sphere", {.spacing = Vector3d::Constant(4), .noise = 1});
  forEachVoxel(clean, [&](const Vector3i& at, std::int32_t label) {
    const Neighbours neighbours = neighboursOf(clean, at);
    const bool onSurface = neighbours.differFrom(label);
    EXPECT_EQ(noisy.at(0, at) != label, onSurface);
  });
}

TEST(Phantom, TheSeedDecidesTheNoise) {
  const auto voxels = [](std::uint32_t seed) {
    return makePhantom("sphere", {.noise = 0.2, .seed = seed}).layers[0];
  };
  EXPECT_EQ(voxels(5), voxels(5));
  EXPECT_NE(voxels(5), voxels(6));
}

TEST(Phantom, RefusesWhatItCannotMake) {
  const auto message = [](const std::string& name, const PhantomOptions& options) {
    return test::messageOf<std::invalid_argument>([&] { makePhantom(name, options); });
  };
  EXPECT_NE(message("knee", {}).find("upper-arm, thin, sphere, torus, nested"), std::string::npos);
  EXPECT_NE(message("sphere", {.spacing = Vector3d(1, 0, 1)}), "");
  EXPECT_NE(message("sphere", {.spacing = Vector3d(1, NAN, 1)}), "");
  EXPECT_NE(message("sphere", {.spacing = Vector3d::Constant(1e-3)}), "");
  EXPECT_NE(message("sphere", {.tiltDeg = INFINITY}), "");
  EXPECT_NE(message("sphere", {.noise = -0.1}), "");
  EXPECT_NE(message("sphere", {.noise = 1.1}), "");
  EXPECT_NE(message("sphere", {.noise = NAN}), "");
}

}  // namespace
}  // namespace sinew
