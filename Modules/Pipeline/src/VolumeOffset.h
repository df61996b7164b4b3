#pragma once

#include <optional>
#include <vector>

namespace sinew {

/// A mesh whose target surface was moved to keep the volume.
struct OffsetTrial {
  double offset = 0;  ///< outwards, mm
  double volume = 0;  ///< of the mesh, mm^3
};

/// How far one goes for the volume.
struct VolumeRule {
  double tolerance;     ///< of the volume: what is less wrong is good
  int trials;           ///< at most, each for moved boundaries and for new meshes
  double largestEdges;  ///< largest offset, edge lengths
  bool remesh;          ///< mesh the moved surface anew where moving the boundary does not do
};
inline constexpr VolumeRule kNoticeableVolume{0.005, 4, 0.05, false};
inline constexpr VolumeRule kExactVolume{0.001, 4, 0.1, true};
constexpr const VolumeRule& volumeRule(bool exact) { return exact ? kExactVolume : kNoticeableVolume; }

/// Whether a trial is as near to the wanted volume as the rule asks.
bool goodVolume(const OffsetTrial& trial, double wantedVolume, const VolumeRule& rule);

/// The trial whose volume is nearest to the wanted one; the first of equals.
std::size_t bestTrial(const std::vector<OffsetTrial>& trials, double wantedVolume);

/// Offset to try next, mm: what is missing over the area, and once there are two trials along their secant.
/// @param trials  at least one
/// @param area    of the surface, mm^2
/// @param edge    edge length, mm
/// @return nothing when the best trial is good or the rule allows no more
std::optional<double> nextOffset(const std::vector<OffsetTrial>& trials, double wantedVolume, double area,
                                 double edge, const VolumeRule& rule);

}  // namespace sinew
