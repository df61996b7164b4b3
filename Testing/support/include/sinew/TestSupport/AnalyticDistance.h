#pragma once

#include "sinew/Mesher/SignedDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace sinew::test {

/// How an analytic shape pretends to have been sampled.
struct AnalyticOptions {
  double resolution = 1;                                  ///< mm
  double band = std::numeric_limits<double>::infinity();  ///< mm; phi is clamped to +-band
};

/// Base of the exact distances below: a shape gives phi and its unit gradient, this class clamps to the band.
class AnalyticDistance : public SignedDistance {
 public:
  explicit AnalyticDistance(AnalyticOptions options) : options_(options) {}

  double value(const Eigen::Vector3d& x) const override {
    return std::clamp(exact(x).phi, -options_.band, options_.band);
  }
  double valueAndGradient(const Eigen::Vector3d& x, Eigen::Vector3d& gradient) const override {
    const Sample sample = exact(x);
    const bool clamped = std::abs(sample.phi) >= options_.band;
    gradient = clamped ? Eigen::Vector3d::Zero().eval() : sample.gradient;
    return std::clamp(sample.phi, -options_.band, options_.band);
  }
  double resolution() const override { return options_.resolution; }
  double band() const override { return options_.band; }

  struct Sample {
    double phi;
    Eigen::Vector3d gradient;
  };
  /// The unclamped distance and its gradient.
  virtual Sample exact(const Eigen::Vector3d& x) const = 0;

 private:
  AnalyticOptions options_;
};

/// |x| of a vector and its direction; any unit vector at the origin.
inline AnalyticDistance::Sample lengthAndDirection(const Eigen::Vector3d& x) {
  const double length = x.norm();
  return {length, length > 0 ? Eigen::Vector3d(x / length) : Eigen::Vector3d::UnitZ()};
}

/// A box `margin` wider than [lower, upper] on every side.
inline Eigen::AlignedBox3d grown(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double margin) {
  return {lower - Eigen::Vector3d::Constant(margin), upper + Eigen::Vector3d::Constant(margin)};
}

/// phi = |x - c| - r
class AnalyticSphere : public AnalyticDistance {
 public:
  AnalyticSphere(const Eigen::Vector3d& center, double radius, AnalyticOptions options = {})
      : AnalyticDistance(options), center_(center), radius_(radius) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const auto [length, direction] = lengthAndDirection(x - center_);
    return {length - radius_, direction};
  }
  Eigen::AlignedBox3d bounds() const override { return grown(center_, center_, radius_ * (1 + 1e-9)); }
  double volume() const { return 4 * std::numbers::pi / 3 * radius_ * radius_ * radius_; }
  double area() const { return 4 * std::numbers::pi * radius_ * radius_; }

 private:
  Eigen::Vector3d center_;
  double radius_;
};

/// Axis along z, R: centre line, r: tube.  phi = |(|(x,y)| - R, z)| - r
class AnalyticTorus : public AnalyticDistance {
 public:
  AnalyticTorus(const Eigen::Vector3d& center, double majorRadius, double minorRadius,
                AnalyticOptions options = {})
      : AnalyticDistance(options), center_(center), major_(majorRadius), minor_(minorRadius) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const Eigen::Vector3d d = x - center_;
    const auto [rho, outward] = lengthAndDirection({d.x(), d.y(), 0});
    const Eigen::Vector3d nearestOnLine = (rho > 0 ? outward : Eigen::Vector3d::UnitX()) * major_;
    const auto [length, direction] = lengthAndDirection(d - nearestOnLine);
    return {length - minor_, direction};
  }
  Eigen::AlignedBox3d bounds() const override {
    const Eigen::Vector3d half(major_ + minor_, major_ + minor_, minor_);
    return grown(center_ - half, center_ + half, 1e-9 * minor_);
  }
  double volume() const { return 2 * std::numbers::pi * std::numbers::pi * major_ * minor_ * minor_; }
  double area() const { return 4 * std::numbers::pi * std::numbers::pi * major_ * minor_; }

 private:
  Eigen::Vector3d center_;
  double major_, minor_;
};

/// A box with sharp edges: the distance is exact, the gradient jumps at the medial planes.
class AnalyticBox : public AnalyticDistance {
 public:
  AnalyticBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, AnalyticOptions options = {})
      : AnalyticDistance(options), lower_(lower), upper_(upper) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const Eigen::Vector3d d = x - (lower_ + upper_) / 2;
    const Eigen::Vector3d beyond = d.cwiseAbs() - (upper_ - lower_) / 2;
    const Eigen::Vector3d sign = d.unaryExpr([](double c) { return c < 0 ? -1.0 : 1.0; });
    if ((beyond.array() <= 0).all()) {
      int axis = 0;
      const double phi = beyond.maxCoeff(&axis);
      return {phi, sign[axis] * Eigen::Vector3d::Unit(axis)};
    }
    const auto [length, direction] = lengthAndDirection(beyond.cwiseMax(0));
    return {length, direction.cwiseProduct(sign)};
  }
  Eigen::AlignedBox3d bounds() const override {
    return grown(lower_, upper_, 1e-9 * (upper_ - lower_).maxCoeff());
  }
  double volume() const { return (upper_ - lower_).prod(); }

 private:
  Eigen::Vector3d lower_, upper_;
};

/// Points within `radius` of the segment a-b.
class AnalyticCapsule : public AnalyticDistance {
 public:
  AnalyticCapsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius,
                  AnalyticOptions options = {})
      : AnalyticDistance(options), a_(a), b_(b), radius_(radius) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const Eigen::Vector3d ab = b_ - a_;
    const double t = std::clamp((x - a_).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    const auto [length, direction] = lengthAndDirection(x - a_ - t * ab);
    return {length - radius_, direction};
  }
  Eigen::AlignedBox3d bounds() const override {
    return grown(a_.cwiseMin(b_), a_.cwiseMax(b_), radius_ * (1 + 1e-9));
  }
  double volume() const {
    return std::numbers::pi * radius_ * radius_ * ((b_ - a_).norm() + 4.0 / 3 * radius_);
  }

 private:
  Eigen::Vector3d a_, b_;
  double radius_;
};

/// The union of shapes, phi = min phi_i: exact outside and near the surface away from creases.
class AnalyticUnion : public AnalyticDistance {
 public:
  explicit AnalyticUnion(std::vector<std::shared_ptr<const AnalyticDistance>> parts,
                         AnalyticOptions options = {})
      : AnalyticDistance(options), parts_(std::move(parts)) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    Sample nearest = parts_.front()->exact(x);
    for (const auto& part : parts_) {
      const Sample sample = part->exact(x);
      if (sample.phi < nearest.phi) nearest = sample;
    }
    return nearest;
  }
  Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    for (const auto& part : parts_) box.extend(part->bounds());
    return box;
  }

 private:
  std::vector<std::shared_ptr<const AnalyticDistance>> parts_;
};

/// Everything in `outer` that is not in `inner`: phi = max(outer, -inner); a shell when inner lies inside
/// outer.
class AnalyticDifference : public AnalyticDistance {
 public:
  AnalyticDifference(std::shared_ptr<const AnalyticDistance> outer,
                     std::shared_ptr<const AnalyticDistance> inner, AnalyticOptions options = {})
      : AnalyticDistance(options), outer_(std::move(outer)), inner_(std::move(inner)) {}

  Sample exact(const Eigen::Vector3d& x) const override {
    const Sample outer = outer_->exact(x), inner = inner_->exact(x);
    return outer.phi >= -inner.phi ? outer : Sample{-inner.phi, -inner.gradient};
  }
  Eigen::AlignedBox3d bounds() const override { return outer_->bounds(); }

 private:
  std::shared_ptr<const AnalyticDistance> outer_, inner_;
};

}  // namespace sinew::test
