#include "sinew/Elasticity/BsplineSolid.h"

#include "NodeSums.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/BVH>
#include <unsupported/Eigen/Splines>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Knots = BsplineSolid::Knots;
using Curve = Eigen::Spline<double, 1, Eigen::Dynamic>;

constexpr int kDegree = 3;
constexpr std::array<char, 3> kNames{'u', 'v', 'w'};

int degreeOf(int count) { return std::min(kDegree, count - 1); }

/// 0 and 1 degree + 1 times each, and the spans between them of one length.
Knots clampedKnots(int count) {
  const int degree = degreeOf(count), spans = count - degree;
  Knots knots(count + degree + 1);
  for (int k = 0; k < knots.size(); ++k)
    knots[k] = std::clamp(static_cast<double>(k - degree) / spans, 0., 1.);
  return knots;
}

/// The splines of one direction that are not zero at a parameter.
struct Basis {
  int first;             ///< the control point of the first of them
  Eigen::ArrayXXd rows;  ///< values, then slopes
};

Basis basisAt(double parameter, int count, const Knots& knots) {
  const int degree = degreeOf(count);
  return {static_cast<int>(Curve::Span(parameter, degree, knots)) - degree,
          Curve::BasisFunctionDerivatives(parameter, 1, degree, knots)};
}

/// Middles of `perSpan` equal parts of each span of a direction; with the ends of the direction when asked.
std::vector<double> samplesOf(int count, int perSpan, bool withEnds) {
  const int samples = (count - degreeOf(count)) * perSpan;
  std::vector<double> parameters;
  if (withEnds) parameters.push_back(0);
  for (int s = 0; s < samples; ++s) parameters.push_back((s + 0.5) / samples);
  if (withEnds) parameters.push_back(1);
  return parameters;
}

/// Every combination of samples along the three directions.
NodeVectors sampleGrid(const std::array<int, 3>& counts, int perSpan, bool withEnds) {
  NodeVectors grid;
  for (const double w : samplesOf(counts[2], perSpan, withEnds))
    for (const double v : samplesOf(counts[1], perSpan, withEnds))
      for (const double u : samplesOf(counts[0], perSpan, withEnds)) grid.emplace_back(u, v, w);
  return grid;
}

Vector3d clampToUnit(const Vector3d& parameters) { return parameters.cwiseMax(0).cwiseMin(1); }

/// The damped Gauss-Newton step towards x; parameters at a bound stay there when the step would leave it.
/// @param off  x - S
Vector3d boundedStep(const Vector3d& parameters, const Matrix3d& slopes, const Vector3d& off,
                     double damping) {
  const Vector3d downhill = slopes.transpose() * off;
  Matrix3d free = slopes;
  for (int axis = 0; axis < 3; ++axis)
    if ((parameters[axis] <= 0 && downhill[axis] < 0) || (parameters[axis] >= 1 && downhill[axis] > 0))
      free.col(axis).setZero();
  Matrix3d normal = free.transpose() * free;
  normal.diagonal().array() += damping * normal.trace() + std::numeric_limits<double>::min();
  return normal.ldlt().solve(free.transpose() * off);
}

/// A place of the solid by its number.
struct Sample {
  Vector3d x;
  std::size_t number;
};

/// Eigen's tree asks for it by this name.
Eigen::AlignedBox3d bounding_box(const Sample& sample) { return Eigen::AlignedBox3d(sample.x); }

/// What Eigen's tree minimizes; it keeps the sample that it found.
struct DistanceFrom {
  using Scalar = double;
  const Vector3d& x;
  double least = std::numeric_limits<double>::infinity();
  std::size_t number = 0;

  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.squaredExteriorDistance(x); }
  double minimumOnObject(const Sample& sample) {
    const double distance = (sample.x - x).squaredNorm();
    if (distance < least) {
      least = distance;
      number = sample.number;
    }
    return distance;
  }
};

Vector3d unitOrZero(const Vector3d& vector) {
  const double length = vector.norm();
  return length > 0 ? Vector3d(vector / length) : Vector3d::Zero();
}

}  // namespace

/// Where the search for nearest points starts.
struct BsplineSolid::Samples {
  NodeVectors parameters;
  Eigen::KdBVH<double, 3, Sample> tree;
};

BsplineSolid::BsplineSolid(const std::array<int, 3>& counts, NodeVectors points)
    : counts_(counts), points_(std::move(points)) {
  std::size_t wanted = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (counts[axis] < 2)
      throw std::invalid_argument(std::to_string(counts[axis]) + " control points along " + kNames[axis] +
                                  "; at least 2 are needed");
    wanted *= static_cast<std::size_t>(counts[axis]);
    knots_[axis] = clampedKnots(counts[axis]);
  }
  if (points_.size() != wanted)
    throw std::invalid_argument(std::to_string(points_.size()) + " control points; the counts ask for " +
                                std::to_string(wanted));
  checkUnfolded();
  constexpr int kPerSpan = 5;
  NodeVectors parameters = sampleGrid(counts_, kPerSpan, true);
  std::vector<Sample> samples;
  for (const Vector3d& place : parameters) samples.push_back({at(place).x, samples.size()});
  samples_ = std::make_shared<const Samples>(std::move(parameters),
                                             Eigen::KdBVH<double, 3, Sample>(samples.begin(), samples.end()));
}

void BsplineSolid::checkUnfolded() const {
  constexpr int kPerSpan = 3;
  constexpr double kFlat = 1e-6;  // of a volume over the product of its edges
  double turn = 0;
  for (const Vector3d& parameters : sampleGrid(counts_, kPerSpan, false)) {
    const Matrix3d slopes = at(parameters).slopes;
    const double sine = slopes.determinant() / slopes.colwise().norm().prod();
    if (turn == 0) turn = sine;
    if (std::abs(sine) > kFlat && sine * turn > 0) continue;
    std::ostringstream place;
    place.imbue(std::locale::classic());
    place.precision(3);
    place << parameters[0] << ", " << parameters[1] << ", " << parameters[2];
    throw std::invalid_argument("the solid is folded or flat at u, v, w = " + place.str());
  }
}

BsplineSolid::Place BsplineSolid::at(const Vector3d& parameters) const {
  std::array<Basis, 3> basis;
  for (std::size_t axis = 0; axis < 3; ++axis)
    basis[axis] = basisAt(parameters[static_cast<Eigen::Index>(axis)], counts_[axis], knots_[axis]);
  const auto& [u, v, w] = basis;
  Place place{Vector3d::Zero(), Matrix3d::Zero()};
  for (int k = 0; k < w.rows.cols(); ++k)
    for (int j = 0; j < v.rows.cols(); ++j)
      for (int i = 0; i < u.rows.cols(); ++i) {
        const int point = u.first + i + counts_[0] * (v.first + j + counts_[1] * (w.first + k));
        const Vector3d& p = points_[static_cast<std::size_t>(point)];
        const double a = u.rows(0, i), b = v.rows(0, j), c = w.rows(0, k);
        place.x += a * b * c * p;
        place.slopes.col(0) += u.rows(1, i) * b * c * p;
        place.slopes.col(1) += a * v.rows(1, j) * c * p;
        place.slopes.col(2) += a * b * w.rows(1, k) * p;
      }
  return place;
}

Vector3d BsplineSolid::nearest(const Vector3d& x) const {
  constexpr int kMostSteps = 100;
  constexpr double kSmallestStep = 1e-12, kLeastDamping = 1e-15, kMostDamping = 1e6;
  DistanceFrom from{x};
  Eigen::BVMinimize(samples_->tree, from);
  Vector3d parameters = samples_->parameters[from.number];
  Place here = at(parameters);
  double damping = 1e-6;
  for (int step = 0; step < kMostSteps && damping < kMostDamping; ++step) {
    const Vector3d next = clampToUnit(parameters + boundedStep(parameters, here.slopes, x - here.x, damping));
    if ((next - parameters).norm() < kSmallestStep) break;
    const Place there = at(next);
    if ((x - there.x).squaredNorm() > (x - here.x).squaredNorm()) {
      damping *= 10;
      continue;
    }
    parameters = next;
    here = there;
    damping = std::max(damping / 10, kLeastDamping);
  }
  return parameters;
}

Vector3d BsplineSolid::fibre(const Vector3d& x) const { return unitOrZero(at(nearest(x)).slopes.col(2)); }

SplineFibres splineFibres(const TetMesh& mesh, const BsplineSolid& solid) {
  SplineFibres fibres{NodeVectors(mesh.tets.size()), std::vector<double>(mesh.tets.size())};
  forEachIndex(mesh.tets.size(), [&](std::size_t t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const Vector3d middle = (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c] + mesh.nodes[d]) / 4;
    const BsplineSolid::Place place = solid.at(solid.nearest(middle));
    fibres.directions[t] = unitOrZero(place.slopes.col(2));
    fibres.distances[t] = (place.x - middle).norm();
  });
  return fibres;
}

}  // namespace sinew
