#include "sinew/LevelSet/Offset.h"

#include "MarchOn.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Samples from the surface within which a level set is the exact distance.
constexpr double kExact = 3;
/// Samples that redistance looks at around the surface: two along each axis.
constexpr double kAround = 4;

/// The box in which the shape grown by `distance` has its band.
DenseLevelSet grownBox(const DenseLevelSet& levelSet, double distance) {
  constexpr double kMostSamples = 2147483648.0;
  const double layers = std::ceil(distance / levelSet.voxelSize) + 1;
  const Vector3d size = levelSet.phi.size.cast<double>() + Vector3d::Constant(2 * layers);
  if (!(size.prod() <= kMostSamples))
    throw std::invalid_argument("offset: distance " + std::to_string(distance) +
                                " mm needs more than 2^31 samples");
  const Vector3i margin = Vector3i::Constant(static_cast<int>(layers));
  return onBox(levelSet, -margin, levelSet.phi.size - Vector3i::Ones() + margin);
}

/// Whether no ball of this radius fits into the box of the samples.
bool isDeeperThan(double radius, const DenseLevelSet& levelSet) {
  return 2 * radius > levelSet.voxelSize * levelSet.phi.size.minCoeff();
}

void requireRadius(double radius, const char* operation) {
  if (!(radius >= 0) || !std::isfinite(radius))
    throw std::invalid_argument(std::string(operation) + ": radius must not be negative, got " +
                                std::to_string(radius));
}

}  // namespace

DenseLevelSet offset(const DenseLevelSet& levelSet, double distance) {
  if (!std::isfinite(distance))
    throw std::invalid_argument("offset: distance must be finite, got " + std::to_string(distance));
  if (distance == 0) return levelSet;
  if (isDeeperThan(-distance, levelSet))
    return emptyLevelSet({levelSet.frame, levelSet.voxelSize}, Vector3i::Zero(), Vector3i::Zero(),
                         levelSet.band);
  DenseLevelSet result = distance > 0 ? grownBox(levelSet, distance) : levelSet;
  marchOn(result.phi, levelSet.voxelSize, std::min(levelSet.band, kExact * levelSet.voxelSize),
          std::abs(distance) + kAround * levelSet.voxelSize);
  for (float& phi : result.phi.values) phi -= static_cast<float>(distance);
  redistance(result);
  return trimmed(result);
}

DenseLevelSet opening(const DenseLevelSet& levelSet, double radius) {
  requireRadius(radius, "opening");
  return offset(offset(levelSet, -radius), radius);
}

DenseLevelSet closing(const DenseLevelSet& levelSet, double radius) {
  requireRadius(radius, "closing");
  return offset(offset(levelSet, radius), -radius);
}

}  // namespace sinew
