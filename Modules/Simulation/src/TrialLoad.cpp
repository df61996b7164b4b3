#include "TrialLoad.h"

#include "Indenter.h"
#include "TetMiddle.h"
#include "TrialText.h"
#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/Elasticity/HarmonicField.h"

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;

std::unique_ptr<Muscle> muscleOf(const TrialSetup& setup, const MuscleOptions& options) {
  std::vector<MuscleFibre> fibres(setup.fibres.size());
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    fibres[t].direction = setup.fibres[t];
    if (!setup.tendons.empty()) fibres[t].tendon = setup.tendons[t];
  }
  return std::make_unique<Muscle>(std::move(fibres), options);
}

std::unique_ptr<Material> materialOf(const TrialSetup& setup, const TrialOptions& options) {
  if (options.trial == Trial::Contract) return muscleOf(setup, options.muscle);
  const double mu = options.tissue.shear;
  return neoHookean({.mu = mu, .lambda = options.tissue.bulk - 2. / 3 * mu});
}

Vector3d meanPlace(const NodeVectors& places, const std::vector<std::int32_t>& nodes) {
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t node : nodes) sum += places[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

TrialLoad::TrialLoad(const TetMesh& mesh, const ElasticBody& body, const TrialSetup& setup,
                     const TrialOptions& options)
    : trial_(options.trial), material_(materialOf(setup, options)), constraints_(body.nodeCount()) {
  if (trial_ == Trial::Indent)
    pushPatch(mesh, body, setup.attachments, options);
  else
    moveEnds(body, setup.attachments, options);
  holdLoosePieces(body);
}

void TrialLoad::hold(const std::vector<std::int32_t>& nodes, double share, std::vector<double>& shares) {
  for (const std::int32_t node : nodes) {
    constraints_.freedom[static_cast<std::size_t>(node)] = NodeFreedom::Held;
    shares[static_cast<std::size_t>(node)] = share;
  }
}

void TrialLoad::holdLoosePieces(const ElasticBody& body) {
  loose_ = findLoosePieces(body, constraints_);
  if (2 * loose_.tets > std::ssize(body.tets))
    throw std::invalid_argument(
        "nothing holds " + std::to_string(loose_.tets) + " of the " + std::to_string(body.tets.size()) +
        " tets, the first near " +
        placeText(tetMiddle(body.rest, body.tets[static_cast<std::size_t>(loose_.firstTet)])) +
        "; let the ends be on the largest piece of the mesh");
  hold(loose_.nodes, 0, share_);
}

void TrialLoad::moveEnds(const ElasticBody& body, const Attachments& ends, const TrialOptions& options) {
  if (!areConnected(body, ends.origin, ends.insertion))
    throw std::invalid_argument(
        "no piece of the mesh reaches from the origin to the insertion; let both be on its largest "
        "piece");
  std::vector<double> shares(body.nodeCount(), kWanted);
  hold(ends.origin, 0, shares);
  hold(ends.insertion, 1, shares);
  share_ = trial_ == Trial::Contract ? shares : harmonicField(body, shares);
  onAxis_ = meanPlace(body.rest, ends.origin);
  const Vector3d way = meanPlace(body.rest, ends.insertion) - onAxis_;
  axis_ = options.axis.value_or(way).normalized();
  shift_ = way.dot(axis_) * axis_ * (trial_ == Trial::Compress ? -1 : 1);
}

void TrialLoad::pushPatch(const TetMesh& mesh, const ElasticBody& body, const Attachments& ends,
                          const TrialOptions& options) {
  const Vector3d start = meanPlace(body.rest, ends.origin), end = meanPlace(body.rest, ends.insertion);
  const Vector3d axis = options.axis.value_or(end - start).normalized();
  const Indenter indenter = placeIndenter(mesh, (start + end) / 2, axis, options.push);
  std::vector<double> shares(body.nodeCount(), kWanted);
  hold(indenter.bed, 0, shares);
  for (std::size_t n = 0; n < indenter.patch.size(); ++n)
    hold({indenter.patch[n]}, indenter.shares[n], shares);
  share_ = harmonicField(body, shares);
  shift_ = indenter.thickness * indenter.push;
}

void TrialLoad::activate(double amount) {
  if (trial_ == Trial::Contract) static_cast<Muscle&>(*material_).activate(amount);
}

void TrialLoad::carry(double change, NodeVectors& places) const {
  if (trial_ == Trial::Contract) return;
  constexpr double kRadians = std::numbers::pi / 180;
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
    if (trial_ == Trial::Twist)
      places[n] = onAxis_ + Eigen::AngleAxisd(kRadians * change * share_[n], axis_) * (places[n] - onAxis_);
    else
      places[n] += change * share_[n] * shift_;
  });
}

double TrialLoad::force(const ElasticBody& body, const NodeVectors& places) const {
  NodeVectors forces(places.size(), Vector3d::Zero());
  addElasticForces(body, *material_, places, forces);
  double sum = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (constraints_.freedom[n] != NodeFreedom::Held) continue;
    const Vector3d way =
        trial_ == Trial::Twist ? Vector3d(axis_.cross(places[n] - onAxis_)) : Vector3d(shift_.normalized());
    sum -= share_[n] * way.dot(forces[n]);
  }
  return sum;
}

}  // namespace sinew
