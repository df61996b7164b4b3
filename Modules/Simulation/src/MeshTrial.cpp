#include "sinew/Simulation/MeshTrial.h"

#include "sinew/Mesher/MeshQuality.h"

#include <stdexcept>

namespace sinew {
namespace {

struct TrialRow {
  std::string_view name;
  double amount;
};

/// In the order of Trial.
constexpr std::array<TrialRow, kTrials.size()> kRows{
    {{"contract", 1}, {"compress", 0.3}, {"indent", 0.3}, {"stretch", 0.3}, {"twist", 90}}};

const TrialRow& row(Trial trial) { return kRows[static_cast<std::size_t>(trial)]; }

/// The frame at rest.
TrialFrame frameAtRest(const TetMesh& mesh) {
  const MeshQuality quality = meshQuality(mesh);
  TrialFrame frame;
  frame.maxAspectRatio = quality.maxAspectRatio;
  frame.minDihedralDeg = quality.minDihedralDeg;
  frame.maxDihedralDeg = quality.maxDihedralDeg;
  frame.volume = quality.volume;
  frame.converged = true;
  return frame;
}

}  // namespace

std::string_view trialName(Trial trial) { return row(trial).name; }
double usualAmount(Trial trial) { return row(trial).amount; }

TrialReport runTrial(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options,
                     const OnTrialFrame& onFrame) {
  if (setup.attachments.origin.empty() || setup.attachments.insertion.empty())
    throw std::invalid_argument("runTrial: there is no node at an end of the mesh");
  const ElasticBody body = elasticBody(mesh);
  TrialReport report;
  report.frames.push_back(frameAtRest(mesh));
  if (onFrame) onFrame(report.frames.front(), body.rest);
  report.verdict = std::string(trialName(options.trial)) + " is not simulated yet";
  return report;
}

}  // namespace sinew
