#include "TrialMarch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew {
namespace {

constexpr int kNewtonSteps = 40;  // more say that there is no balance nearby

/// That a tet of the mean size gives a node at a shear strain of 1e-4: below it, forces are about rounding.
double leastForceOf(const ElasticBody& body, double shear) {
  constexpr double kLeastStrain = 1e-4;
  const double volume = std::accumulate(body.volumes.begin(), body.volumes.end(), 0.);
  return kLeastStrain * shear * std::pow(volume / static_cast<double>(body.tets.size()), 2. / 3);
}

}  // namespace

TrialMarch::TrialMarch(const ElasticBody& body, TrialLoad& load, const TrialOptions& options)
    : body_(body),
      load_(load),
      tolerance_(options.tolerance),
      halvings_(options.halvings),
      places_(body.rest),
      largestForce_(leastForceOf(
          body, options.trial == Trial::Contract ? options.muscle.shear : options.tissue.shear)) {}

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
  const EquilibriumReport report =
      findEquilibrium(body_, load_.material(), load_.constraints(), {}, next,
                      {.tolerance = tolerance_, .leastForce = largestForce_, .steps = kNewtonSteps});
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
