#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <limits>

namespace sinew {

/// A node whose value of a harmonic field is wanted.
inline constexpr double kWanted = std::numeric_limits<double>::quiet_NaN();

/// The harmonic field with the given values, through whose boundary nothing flows where none is given: the
/// smoothest continuation into the body. 0 in pieces of it without a given value.
/// @param given  per node, kWanted where wanted
/// @throws std::invalid_argument when there is not one per node
/// Cost: one solution of a sparse system of the nodes by conjugate gradients.
std::vector<double> harmonicField(const ElasticBody& body, const std::vector<double>& given);

}  // namespace sinew
