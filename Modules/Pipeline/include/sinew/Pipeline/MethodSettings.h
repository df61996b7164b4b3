#pragma once

#include "sinew/Elasticity/CompressionMethod.h"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sinew {

/// Names of the methods, as a person writes them: optimization, springs, fem, hybrid.
const std::vector<std::string>& methodNames();
std::string toString(CompressionMethod method);
/// @throws std::invalid_argument listing the names when it is none of them
CompressionMethod parseMethod(std::string_view name);

/// Sets one option of physics from a text KEY=VALUE; the keys are those of physicsSettings.
/// @throws std::invalid_argument on a text that is no such pair, a key that is unknown or without effect on
/// the method, a value that is out of range
void setPhysics(std::string_view text, CompressionMethod method, PhysicsCompressionOptions& physics);

using PhysicsValue = std::variant<bool, int, double, std::string>;

/// The options of physics that have an effect on a method, by their keys; none for Optimization.
std::vector<std::pair<std::string, PhysicsValue>> physicsSettings(CompressionMethod method,
                                                                  const PhysicsCompressionOptions& physics);

/// All keys with their defaults: `material=neo-hookean, poisson=0.1, ...`.
std::string physicsHelp();

}  // namespace sinew
