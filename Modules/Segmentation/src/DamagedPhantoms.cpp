#include "PhantomShapes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sinew {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Color = std::array<double, 3>;

constexpr Color kBone{0.95, 0.84, 0.57}, kMuscle{0.75, 0.31, 0.29}, kOtherMuscle{0.66, 0.25, 0.33},
    kVessel{0.84, 0.12, 0.12}, kLiver{0.70, 0.40, 0.30};

/// An ellipse swept along z whose half axes swell by a cosine from the ends to the middle.
struct Spindle {
  Vector3d middle;
  double halfLength, rx, ry, ends;  ///< `ends`: half axes there, as part of those in the middle

  bool contains(const Vector3d& x) const {
    const Vector3d d = x - middle;
    if (std::abs(d.z()) >= halfLength) return false;
    constexpr double kPi = 3.14159265358979323846;
    const double swell = ends + (1 - ends) * 0.5 * (1 + std::cos(kPi * d.z() / halfLength));
    return std::pow(d.x() / (rx * swell), 2) + std::pow(d.y() / (ry * swell), 2) < 1;
  }
};

/// A shaft of bone through which a drill of 5 mm went.
bool drilledFemur(const Vector3d& x) {
  const double swell = 1 + 0.35 * std::pow(x.z() / 35, 4);
  const bool bone = std::abs(x.z()) < 35 && std::hypot(x.x() / 13, x.y() / 11.5) < swell;
  const bool drill = std::hypot(x.x() - 0.25 * x.y(), x.z() - 4) < 2.5;
  return bone && !drill;
}

/// A muscle of which one slice was not drawn.
bool gappedMuscle(const Vector3d& x) {
  static const Spindle belly{{0, 0, 0}, 45, 14, 9, 0.25};
  const bool missing = x.z() > 5.9 && x.z() < 9.1;
  return belly.contains(x) && !missing;
}

/// The middle of a vessel that runs in an arc, at a height z.
Vector3d arc(double z) { return {8 * std::cos(z / 18), 5 * std::sin(z / 25), z}; }

/// A vessel of 5 mm with 7 mm lost on the way.
bool tornVessel(const Vector3d& x) {
  const bool lost = x.z() > -3 && x.z() < 4;
  return !lost && std::abs(x.z()) < 34 && (x - arc(x.z())).head<2>().norm() < 2.5;
}

/// A liver of sorts with specks around it and pinholes in it, at fixed places.
bool speckledLiver(const Vector3d& x) {
  static const std::vector<Vector3d> specks{{22, 14, 8},   {-24, 10, -6}, {12, -20, 10},
                                            {-16, -18, 2}, {2, 4, 21},    {25, -6, -9}};
  static const std::vector<Vector3d> pinholes{{6, 1, 1}, {-9, 1, -3}, {-1, -1, 6}, {12, 0, -4}};
  const auto near = [&](const std::vector<Vector3d>& places, double radius) {
    return std::ranges::any_of(places, [&](const Vector3d& p) { return (x - p).norm() < radius; });
  };
  const bool liver = std::hypot(x.x() / 20, x.y() / 14, x.z() / 12) < 1;
  return (liver && !near(pinholes, 2)) || near(specks, 2.2);
}

}  // namespace

std::vector<PhantomShape> damagedPhantoms() {
  static const Spindle medial{{-5, 0, 0}, 40, 10, 8, 0.3}, lateral{{6, 1, 4}, 40, 10, 8, 0.3};
  return {
      {.name = "drilled-femur",
       .description = "a shaft of bone with a drill hole of 5 mm; 0.8 mm",
       .region = AlignedBox3d(Vector3d(-22, -20, -40), Vector3d(22, 20, 40)),
       .spacing = {0.8, 0.8, 0.8},
       .tiltDeg = 0,
       .parts = {{1, "femur", kBone, drilledFemur}}},
      {.name = "gapped-muscle",
       .description = "a muscle of which one slice was not drawn; 0.8 x 0.8 x 3 mm",
       .region = AlignedBox3d(Vector3d(-19, -14, -50), Vector3d(19, 14, 50)),
       .spacing = {0.8, 0.8, 3},
       .tiltDeg = 0,
       .parts = {{1, "muscle", kMuscle, gappedMuscle}}},
      {.name = "torn-vessel",
       .description = "a vessel of 5 mm that is lost for 7 mm; 0.8 mm",
       .region = AlignedBox3d(Vector3d(-8, -10, -39), Vector3d(16, 10, 39)),
       .spacing = {0.8, 0.8, 0.8},
       .tiltDeg = 0,
       .parts = {{1, "vessel", kVessel, tornVessel}}},
      {.name = "speckled-liver",
       .description = "an organ with six specks around it and four pinholes in it; 1 mm",
       .region = AlignedBox3d(Vector3d(-30, -26, -18), Vector3d(30, 26, 26)),
       .spacing = {1, 1, 1},
       .tiltDeg = 0,
       .parts = {{1, "liver", kLiver, speckledLiver}}},
      {.name = "overlapping-muscles",
       .description = "two muscles, drawn by two people, that share 5 mm; on two layers; 1 mm",
       .region = AlignedBox3d(Vector3d(-20, -14, -46), Vector3d(22, 15, 50)),
       .spacing = {1, 1, 1},
       .tiltDeg = 0,
       .parts = {{1, "vastus medialis", kMuscle, [](const Vector3d& x) { return medial.contains(x); }},
                 {1, "rectus femoris", kOtherMuscle, [](const Vector3d& x) { return lateral.contains(x); },
                  1}}},
  };
}

}  // namespace sinew
