#include "TrialMarch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr int kNewtonSteps = 40;  // more say that there is no balance nearby

/// That the largest tet gives a node at a strain of 1e-4 against the stiffest modulus. What is then out of
/// balance at most, a tolerance of it, lies above what the rounding of energies hides from the line search.
double leastForceOf(const ElasticBody& body, const TrialOptions& options) {
  constexpr double kLeastStrain = 1e-4;
  const double modulus = options.trial == Trial::Contract
                             ? std::max(options.muscle.shear, options.muscle.bulk)
                             : std::max(options.tissue.shear, options.tissue.bulk);
  return kLeastStrain * modulus * std::pow(std::ranges::max(body.volumes), 2. / 3);
}

}  // namespace

TrialMarch::TrialMarch(const ElasticBody& body, TrialLoad& load, const TrialOptions& options)
    : body_(body),
      load_(load),
      options_(options),
      places_(body.rest),
      largestForce_(leastForceOf(body, options)) {}

bool TrialMarch::advance(double amount, int halvings) {
  if (step(amount)) return true;
  if (halvings == 0) return false;
  return advance((amount_ + amount) / 2, halvings - 1) && advance(amount, halvings - 1);
}

/// As the load carries the body, plus what the last step added to that, in proportion, where this flattens no
/// tet much.
NodeVectors TrialMarch::guess(double amount) const {
  NodeVectors carried = places_;
  load_.carry(amount - amount_, carried);
  if (!before_) return carried;
  const double ratio = (amount - amount_) / (amount_ - before_->amount);
  NodeVectors next = before_->places;
  load_.carry(amount_ - before_->amount, next);
  tbb::parallel_for(std::size_t{0}, places_.size(),
                    [&](std::size_t n) { next[n] = carried[n] + ratio * (places_[n] - next[n]); });
  constexpr double kFlattening = 0.5;
  const bool good = leastVolumeRatio(body_, next) > kFlattening * leastVolumeRatio(body_, places_);
  return good ? next : carried;
}

bool TrialMarch::step(double amount) {
  NodeVectors next = guess(amount);
  if (!(leastVolumeRatio(body_, next) > 0)) return false;
  load_.activate(amount);
  const EquilibriumReport report = findEquilibrium(body_, load_.material(), load_.constraints(), {}, next,
                                                   {.tolerance = options_.tolerance,
                                                    .leastForce = largestForce_,
                                                    .steps = kNewtonSteps,
                                                    .onStep = options_.onStep});
  newtonSteps_ += report.steps;
  cgIterations_ += report.cgIterations;
  if (!report.converged) {
    load_.activate(amount_);
    return false;
  }
  before_ = Balance{amount_, std::exchange(places_, std::move(next))};
  amount_ = amount;
  residual_ = report.residual;
  largestForce_ = std::max(largestForce_, report.largestForce);
  return true;
}

}  // namespace sinew
