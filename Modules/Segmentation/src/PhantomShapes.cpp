#include "PhantomShapes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sinew {
namespace {

using Color = std::array<double, 3>;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

// ---- the upper arm: ellipses swept along z ----

/// An ellipse in the plane z: centre (x, y), half axes rx, ry, mm.
struct Station {
  double z, x, y, rx, ry;
};

using Stations = std::vector<Station>;
using Column = double Station::*;

/// Cubic through the stations' values, with the slope of the chord between the neighbours (Catmull-Rom).
double interpolate(const Stations& stations, Column column, double z) {
  const auto next = std::ranges::upper_bound(stations, z, {}, &Station::z);
  const std::ptrdiff_t last = std::ssize(stations) - 1;
  const std::ptrdiff_t i = std::clamp<std::ptrdiff_t>(next - stations.begin() - 1, 0, last - 1);
  const auto slope = [&](std::ptrdiff_t at) {
    const Station &before = stations[std::max<std::ptrdiff_t>(at - 1, 0)],
                  &after = stations[std::min(at + 1, last)];
    return (after.*column - before.*column) / (after.z - before.z);
  };
  const double width = stations[i + 1].z - stations[i].z, t = (z - stations[i].z) / width;
  const double blend = t * t * (3 - 2 * t);
  return (1 - blend) * stations[i].*column + blend * stations[i + 1].*column +
         width * t * (1 - t) * ((1 - t) * slope(i) - t * slope(i + 1));
}

/// A sweep from the first station to the last, closed by elliptic caps inside that range.
class Sweep {
 public:
  /// @param cap  length over which both ends taper to a point, mm
  Sweep(Stations stations, double cap) : stations_(std::move(stations)), cap_(cap) {}

  /// How far inside the surface to look, mm.
  struct Inset {
    double across = 0, along = 0;
  };

  bool contains(const Vector3d& x, Inset inset = {0, 0}) const {
    const double lower = stations_.front().z + inset.along, upper = stations_.back().z - inset.along;
    const double toEnd = std::min(x.z() - lower, upper - x.z());
    if (toEnd <= 0) return false;
    const double u = std::max(1 - toEnd / cap_, 0.0), taper = std::sqrt(1 - u * u);
    const auto at = [&](Column column) { return interpolate(stations_, column, x.z()); };
    const double a = (x.x() - at(&Station::x)) / ((at(&Station::rx) - inset.across) * taper);
    const double b = (x.y() - at(&Station::y)) / ((at(&Station::ry) - inset.across) * taper);
    return a * a + b * b < 1;
  }

 private:
  Stations stations_;
  double cap_;
};

std::function<bool(const Vector3d&)> anyOf(std::vector<Sweep> sweeps) {
  return [sweeps = std::move(sweeps)](const Vector3d& x) {
    return std::ranges::any_of(sweeps, [&](const Sweep& sweep) { return sweep.contains(x); });
  };
}

// A small child's right arm, hanging: x to the left of the body, y to the back, z up; the middle of the shaft
// at 0. Rows: z, x, y, rx, ry.

const Sweep kSkin(
    {{-88, 0, 0, 19, 18}, {-50, 0, 0, 20, 20}, {0, 0, 0, 23, 24}, {45, 0, 0, 24, 25}, {88, 0, 0, 22, 22}},
    22);
constexpr Sweep::Inset kSkinThickness{.across = 1.3,
                                      .along = 3};  // the ends must not slip between thick slices

const Sweep kHumerus({{-72, 0, 2, 12, 5},
                      {-62, 0, 1, 10.5, 5.5},
                      {-45, 0, 1, 5.5, 5},
                      {0, 0, 1, 5, 5},
                      {40, 0, 1, 5.5, 5.5},
                      {56, 0, 0, 8, 8},
                      {70, 1, 0, 10, 10}},
                     8);

const Sweep kBiceps({{-50, 0, -9.5, 6, 4},
                     {-25, 0, -11, 12, 6.5},
                     {5, 0, -12.2, 14, 7.5},
                     {30, 0, -12.2, 12, 7},
                     {54, 0, -11.5, 6, 4.5}},
                    16);
const Sweep kBicepsDistalTendon({{-70, 2, -8, 2, 1.6}, {-55, 1, -8.5, 2.2, 1.8}, {-34, 0, -9.5, 2.6, 2}}, 3);
const Sweep kBicepsLongHeadTendon({{36, 3, -11, 2, 1.8}, {52, 4.5, -11, 2.2, 1.8}, {74, 4.5, -12.5, 2, 1.6}},
                                  3);
const Sweep kBicepsShortHeadTendon(
    {{36, -3, -11, 2, 1.8}, {52, -6, -11.5, 2.2, 1.8}, {74, -11, -11.5, 2.2, 1.8}}, 3);

const Sweep kTriceps({{-42, 0, 10, 7, 4.5},
                      {-15, 0, 9.5, 16, 8},
                      {15, 0, 10, 18, 9},
                      {42, 0, 10.5, 14, 8},
                      {60, -2, 11.5, 6, 4.5}},
                     16);
const Sweep kTricepsDistalTendon({{-68, 0, 9.5, 4.5, 1.8}, {-50, 0, 10.5, 5.5, 1.8}, {-26, 0, 13, 6, 2}}, 3);
const Sweep kTricepsProximalTendon({{46, -2, 11, 2.4, 2}, {60, -4, 11.5, 2.4, 2}, {74, -8, 11.5, 2.2, 1.8}},
                                   3);

PhantomShape upperArm() {
  const Color tendon{0.87, 0.85, 0.80};
  return {
      .name = "upper-arm",
      .description =
          "a child's upper arm: humerus, biceps and triceps with their tendons, fat, skin; "
          "0.5 x 0.5 x 2 mm, tilted by 8 degrees",
      .region = AlignedBox3d(Vector3d(-26, -27, -90), Vector3d(26, 27, 90)),
      .spacing = {0.5, 0.5, 2},
      .tiltDeg = 8,
      .parts = {
          {1, "humerus", {0.95, 0.84, 0.57}, anyOf({kHumerus})},
          {2, "biceps", {0.75, 0.31, 0.29}, anyOf({kBiceps})},
          {4, "triceps", {0.66, 0.25, 0.33}, anyOf({kTriceps})},
          {3, "biceps tendons", tendon,
           anyOf({kBicepsDistalTendon, kBicepsLongHeadTendon, kBicepsShortHeadTendon})},
          {5, "triceps tendons", tendon, anyOf({kTricepsDistalTendon, kTricepsProximalTendon})},
          {6, "fat", {0.93, 0.80, 0.38}, [](const Vector3d& x) { return kSkin.contains(x, kSkinThickness); }},
          {7, "skin", {0.88, 0.67, 0.56}, anyOf({kSkin})},
      }};
}

// ---- plates and tubes ----

Color ramp(double t) { return {0.2 + 0.7 * t, 0.7 - 0.4 * t, 0.9 - 0.6 * t}; }

std::string thickness(int voxels) { return std::to_string(voxels) + (voxels == 1 ? " voxel" : " voxels"); }

PhantomPart plate(int voxels, double z) {
  const AlignedBox3d box(Vector3d(4, 8, z), Vector3d(34, 38, z + voxels));
  return {voxels, "plate " + thickness(voxels), ramp(voxels / 4.0),
          [box](const Vector3d& x) { return box.contains(x); }};
}

PhantomPart tube(int voxels, double x0, double y0) {
  constexpr double lumen = 5, lower = 4, upper = 32;
  const auto contains = [=](const Vector3d& x) {
    const double r = std::hypot(x.x() - x0, x.y() - y0);
    return r >= lumen && r < lumen + voxels && x.z() > lower && x.z() < upper;
  };
  return {4 + voxels, "tube " + thickness(voxels), ramp(1 - voxels / 4.0), contains};
}

PhantomShape thin() {
  return {
      .name = "thin",
      .description =
          "plates of 1, 2, 3, 4 voxels (30 x 30 mm) and tubes with walls of 1, 2, 3, 4 voxels (lumen 10 mm "
          "wide, 28 mm long); 1 mm",
      .region = AlignedBox3d(Vector3d(0, 0, 0), Vector3d(80, 46, 36)),
      .spacing = {1, 1, 1},
      .tiltDeg = 0,
      .parts = {plate(1, 4), plate(2, 11), plate(3, 19), plate(4, 28), tube(1, 46, 12), tube(2, 68, 12),
                tube(3, 46, 34), tube(4, 68, 34)}};
}

// ---- shapes with known measures ----

std::function<bool(const Vector3d&)> ball(double radius) {
  return [=](const Vector3d& x) { return x.norm() < radius; };
}

PhantomShape sphere() {
  return {.name = "sphere",
          .description = "a ball of radius 20 mm about the origin; 1 mm",
          .region = AlignedBox3d(Vector3d::Constant(-26), Vector3d::Constant(26)),
          .spacing = {1, 1, 1},
          .tiltDeg = 0,
          .parts = {{1, "sphere", {0.35, 0.60, 0.85}, ball(20)}}};
}

PhantomShape torus() {
  const auto contains = [](const Vector3d& x) {
    return std::hypot(std::hypot(x.x(), x.y()) - 20, x.z()) < 8;
  };
  return {.name = "torus",
          .description = "a torus about the z axis, centre line of radius 20 mm, tube of radius 8 mm; 1 mm",
          .region = AlignedBox3d(Vector3d(-34, -34, -14), Vector3d(34, 34, 14)),
          .spacing = {1, 1, 1},
          .tiltDeg = 0,
          .parts = {{1, "torus", {0.85, 0.55, 0.30}, contains}}};
}

PhantomShape nested() {
  return {.name = "nested",
          .description =
              "a core of radius 8 mm in three shells that end at 14, 20 and 26 mm, about the origin; 1 mm",
          .region = AlignedBox3d(Vector3d::Constant(-32), Vector3d::Constant(32)),
          .spacing = {1, 1, 1},
          .tiltDeg = 0,
          .parts = {{1, "core", ramp(0), ball(8)},
                    {2, "inner shell", ramp(1.0 / 3), ball(14)},
                    {3, "middle shell", ramp(2.0 / 3), ball(20)},
                    {4, "outer shell", ramp(1), ball(26)}}};
}

}  // namespace

const std::vector<PhantomShape>& phantomShapes() {
  static const std::vector<PhantomShape> shapes = [] {
    std::vector<PhantomShape> all{upperArm(), thin(), sphere(), torus(), nested()};
    std::ranges::move(damagedPhantoms(), std::back_inserter(all));
    return all;
  }();
  return shapes;
}

}  // namespace sinew
