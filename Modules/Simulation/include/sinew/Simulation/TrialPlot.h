#pragma once

#include "sinew/Simulation/TrialTable.h"

namespace sinew {

/// What trials measured over time, as a picture in SVG: a chart each of the amount, the largest aspect ratio,
/// the least volume ratio J, the smallest dihedral angle, the energy and the volume; a line for each trial,
/// with a cross at its end where it stopped early. Aspect ratios that span more than a factor of 20 stand on
/// a logarithmic scale.
/// @param trials  of one kind; the legend has their names when there are several
/// @param title   any characters
std::string trialPlot(const std::vector<NamedTrial>& trials, Trial trial, const std::string& title);

}  // namespace sinew
