#include "sinew/Simulation/MeshTrial.h"

#include "TetMiddle.h"
#include "TrialChecks.h"
#include "TrialMarch.h"
#include "TrialVerdict.h"
#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/Mesher/MeshQuality.h"

#include <Eigen/LU>

#include <cmath>

namespace sinew {
namespace {

/// Measures the tets of one body at its places.
class Gauge {
 public:
  Gauge(const TetMesh& mesh, const ElasticBody& body) : mesh_(mesh), body_(body) {}

  TrialFrame measure(const NodeVectors& places) {
    mesh_.nodes = places;
    const MeshQuality quality = meshQuality(mesh_);
    TrialFrame frame;
    frame.maxAspectRatio = quality.maxAspectRatio;
    frame.minDihedralDeg = quality.minDihedralDeg;
    frame.maxDihedralDeg = quality.maxDihedralDeg;
    frame.volume = quality.volume;
    frame.worst = spot(quality.largestAspectRatios.front().tet);
    std::size_t flattest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < body_.tets.size(); ++t) {
      const double J = deformationGradient(body_, places, t).determinant();
      if (J >= least) continue;
      least = J;
      flattest = t;
    }
    frame.minVolumeRatio = least;
    frame.flattest = spot(static_cast<std::int64_t>(flattest));
    return frame;
  }

 private:
  TrialSpot spot(std::int64_t tet) const {
    return {.tet = tet, .place = tetMiddle(body_.rest, body_.tets[static_cast<std::size_t>(tet)])};
  }

  TetMesh mesh_;
  const ElasticBody& body_;
};

/// From 0 up to 1 in the middle of the frames and back to 0.
double heightOf(int frame, int frames) { return 1 - std::abs(2. * frame / frames - 1); }

}  // namespace

TrialReport runTrial(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options,
                     const OnTrialFrame& onFrame) {
  checkTrialOptions(options);
  checkSetup(mesh, setup, options);
  const ElasticBody body = elasticBody(mesh);
  TrialLoad load(mesh, body, setup, options);
  TrialMarch march(body, load, options);
  Gauge gauge(mesh, body);
  TrialReport report;
  report.loosePieces = load.loosePieces().pieces;
  report.looseTets = load.loosePieces().tets;
  const double full = options.amount.value_or(usualAmount(options.trial));
  for (int k = 0; k <= options.frames; ++k) {
    if (k > 0 && !march.advance(full * heightOf(k, options.frames))) {
      report.stoppedAt = march.amount();
      break;
    }
    TrialFrame frame = gauge.measure(march.places());
    frame.time = options.duration * k / options.frames;
    frame.amount = march.amount();
    frame.energy = elasticEnergy(body, load.material(), march.places());
    frame.force = load.force(body, march.places());
    frame.residual = march.residual();
    frame.newtonSteps = march.takeNewtonSteps();
    frame.cgIterations = march.takeCgIterations();
    frame.converged = true;
    report.frames.push_back(frame);
    if (onFrame) onFrame(frame, march.places());
  }
  report.completed = !report.stoppedAt;
  judge(options, report);
  return report;
}

}  // namespace sinew
