#pragma once

#include "sinew/TestSupport/AnalyticDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>

namespace sinew::test {

/// Random shapes of about 10 mm that are hard on a mesher, each in a random place and attitude.
///
/// A field gives phi and its gradient at a point; combinations are distances near their surface only, as
/// those of a scan are.
using Field = std::function<AnalyticDistance::Sample(const Eigen::Vector3d&)>;

template <class Shape>
Field fieldOf(const Shape& shape) {
  return [shape](const Eigen::Vector3d& x) { return shape.exact(x); };
}

/// min(a, b), the crease rounded over the width k: Quilez' polynomial, whose slope stays at most 1.
inline Field blend(const Field& a, const Field& b, double k) {
  return [=](const Eigen::Vector3d& x) {
    const AnalyticDistance::Sample A = a(x), B = b(x);
    const double h = std::clamp(0.5 + 0.5 * (B.phi - A.phi) / k, 0.0, 1.0);
    return AnalyticDistance::Sample{h * A.phi + (1 - h) * B.phi - k * h * (1 - h),
                                    h * A.gradient + (1 - h) * B.gradient};
  };
}
inline Field unite(const Field& a, const Field& b) {
  return [=](const Eigen::Vector3d& x) {
    const AnalyticDistance::Sample A = a(x), B = b(x);
    return A.phi < B.phi ? A : B;
  };
}
inline Field negated(const Field& a) {
  return [=](const Eigen::Vector3d& x) {
    const AnalyticDistance::Sample A = a(x);
    return AnalyticDistance::Sample{-A.phi, -A.gradient};
  };
}
inline Field intersect(const Field& a, const Field& b, double k) {
  return negated(blend(negated(a), negated(b), k));
}

/// A gyroid wall of the given wave length and half thickness, phi = (|g| - t) / slope with the slope of g at
/// g = 0.
inline Field gyroid(double waveLength, double halfThickness) {
  const double w = 2 * std::numbers::pi / waveLength, slope = 1.4 * w;
  return [=](const Eigen::Vector3d& x) {
    const Eigen::Array3d s = (w * x).array().sin(), c = (w * x).array().cos();
    const double g = s[0] * c[1] + s[1] * c[2] + s[2] * c[0], sign = g < 0 ? -1 : 1;
    const Eigen::Vector3d gradient(c[0] * c[1] - s[2] * s[0], c[1] * c[2] - s[0] * s[1],
                                   c[2] * c[0] - s[1] * s[2]);
    return AnalyticDistance::Sample{std::abs(g) / slope - halfThickness, sign * w / slope * gradient};
  };
}

/// A field moved rigidly, inside the ball of radius `reach` about its place.
class RandomShape : public AnalyticDistance {
 public:
  RandomShape(std::string name, Field field, const Eigen::Isometry3d& place, double reach,
              AnalyticOptions options)
      : AnalyticDistance(options),
        name_(std::move(name)),
        field_(std::move(field)),
        place_(place),
        reach_(reach) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const Sample sample = field_(place_.inverse() * x);
    return {sample.phi, place_.linear() * sample.gradient};
  }
  Eigen::AlignedBox3d bounds() const override {
    return grown(place_.translation(), place_.translation(), reach_);
  }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  Field field_;
  Eigen::Isometry3d place_;
  double reach_;
};

class ShapeMaker {
 public:
  explicit ShapeMaker(unsigned seed) : random_(seed) {}

  RandomShape make(int kind, AnalyticOptions options) {
    const Kind& k = kinds[kind];
    Field field = (this->*k.make)();
    return {k.name, std::move(field), anywhere(), k.reach, options};
  }
  static constexpr int kKinds = 8;
  static constexpr int kCompactKinds = 6;  ///< the first ones: those that a lattice of one size can carry
  /// V - E + F of the surface of every shape of a kind in one piece; nothing where it depends on the seed.
  static std::optional<int> eulerCharacteristic(int kind) { return kinds[kind].eulerCharacteristic; }

 private:
  // One draw per statement or initializer: the order of arguments is the compiler's.
  double between(double low, double high) { return low + (high - low) * (double(random_()) / 4294967296.0); }
  Eigen::Vector3d pointIn(double halfWidth) {
    const double x = between(-halfWidth, halfWidth), y = between(-halfWidth, halfWidth);
    return {x, y, between(-halfWidth, halfWidth)};
  }
  Eigen::Isometry3d anywhere() {
    const Eigen::Vector3d place = pointIn(20), axis = pointIn(1);
    return Eigen::Translation3d(place) * Eigen::AngleAxisd(between(0, 3), axis.normalized());
  }
  Field ball(const Eigen::Vector3d& center, double radius) { return fieldOf(AnalyticSphere(center, radius)); }

  Field randomBall(double leastRadius) {
    const double radius = between(leastRadius, 2.5);
    return ball(pointIn(2.5), radius);
  }

  Field blendedSpheres() {
    Field shape = randomBall(1.5);
    for (int n = 0; n < 4; ++n) {
      const double width = between(0.5, 1.5);
      shape = blend(shape, randomBall(1), width);
    }
    return shape;
  }
  Field torus() {
    const double minor = between(0.8, 2);
    return fieldOf(AnalyticTorus(Eigen::Vector3d::Zero(), between(minor + 0.6, 4.8), minor));
  }
  Field gyroidPiece() {
    const double halfThickness = between(0.5, 0.9), waveLength = between(6, 9);
    return intersect(gyroid(waveLength, halfThickness), ball(Eigen::Vector3d::Zero(), 5), 0.5);
  }
  Field thinBridge() {
    const Eigen::Vector3d a(-4, 0, 0), b(4, between(-1, 1), 0);
    const double radiusB = between(1.5, 2.5), radiusA = between(1.5, 2.5);
    const Field ends = unite(ball(a, radiusA), ball(b, radiusB));
    return blend(ends, fieldOf(AnalyticCapsule(a, b, between(0.4, 1))), 0.5);
  }
  Field touchingPieces() {
    const double left = between(1.5, 3), right = between(1.5, 3), gap = between(-0.3, 0.3);
    return unite(ball({-left, 0, 0}, left), ball({right + gap, 0, 0}, right));
  }
  Field box() {
    const double x = between(1, 4), y = between(1, 4), z = between(1, 4);
    return fieldOf(AnalyticBox({-x, -y, -z}, {x, y, z}));
  }
  Field thinPlate() {
    const double x = between(3, 5), y = between(3, 5), z = between(0.4, 0.9);
    return fieldOf(AnalyticBox({-x, -y, -z}, {x, y, z}));
  }
  Field thinRod() {
    const double x = between(3, 5), y = between(-2, 2);
    const Eigen::Vector3d end(x, y, 0);
    return fieldOf(AnalyticCapsule(-end, end, between(0.5, 0.9)));
  }

  struct Kind {
    const char* name;
    Field (ShapeMaker::*make)();
    double reach;  ///< radius of a ball around it, mm
    std::optional<int> eulerCharacteristic;
  };
  static const std::array<Kind, kKinds> kinds;

  std::mt19937 random_;
};

inline constexpr std::array<ShapeMaker::Kind, ShapeMaker::kKinds> ShapeMaker::kinds{
    {{"blended spheres", &ShapeMaker::blendedSpheres, 7, {}},
     {"torus", &ShapeMaker::torus, 7, 0},
     {"gyroid piece", &ShapeMaker::gyroidPiece, 5.5, {}},
     {"thin bridge", &ShapeMaker::thinBridge, 7, 2},
     {"touching pieces", &ShapeMaker::touchingPieces, 7, {}},
     {"box", &ShapeMaker::box, 7, 2},
     {"thin plate", &ShapeMaker::thinPlate, 7.5, 2},
     {"thin rod", &ShapeMaker::thinRod, 7, 2}}};

/// Shape number `seed`: the compact kinds take turns.
inline RandomShape randomShape(unsigned seed, AnalyticOptions options = {}) {
  return ShapeMaker(seed).make(static_cast<int>(seed % ShapeMaker::kCompactKinds), options);
}

}  // namespace sinew::test
