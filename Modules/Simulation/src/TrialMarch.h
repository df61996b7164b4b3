#pragma once

#include "TrialLoad.h"
#include "sinew/Elasticity/Equilibrium.h"

#include <optional>
#include <utility>

namespace sinew {

/// Walks a body from balance to balance as the amount of its load changes.
class TrialMarch {
 public:
  /// From rest at the amount 0.
  TrialMarch(const ElasticBody& body, TrialLoad& load, const TrialOptions& options);

  /// Goes to an amount, by the way of amounts between where one step finds no balance.
  /// @return whether it got there; else amount() and places() are the last balance
  bool advance(double amount) { return advance(amount, options_.halvings); }

  double amount() const { return amount_; }
  const NodeVectors& places() const { return places_; }
  double residual() const { return residual_; }
  /// Since the last call.
  int takeNewtonSteps() { return std::exchange(newtonSteps_, 0); }
  int takeCgIterations() { return std::exchange(cgIterations_, 0); }

 private:
  /// An earlier balance.
  struct Balance {
    double amount;
    NodeVectors places;
  };

  bool advance(double amount, int halvings);
  bool step(double amount);
  NodeVectors guess(double amount) const;

  const ElasticBody& body_;
  TrialLoad& load_;
  const TrialOptions& options_;
  double amount_ = 0;
  NodeVectors places_;
  std::optional<Balance> before_;
  double largestForce_, residual_ = 0;
  int newtonSteps_ = 0, cgIterations_ = 0;
};

}  // namespace sinew
