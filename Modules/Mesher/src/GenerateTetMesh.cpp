#include "sinew/Mesher/GenerateTetMesh.h"

#include "ActiveNodes.h"
#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Mesher/Sizing.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

class StageClock {
 public:
  StageClock(const GenerateTetMeshOptions& options, GenerateTetMeshReport& report)
      : options_(options), report_(report) {}

  void start(std::string_view stage, double fraction) {
    stop();
    if (options_.progress) options_.progress(stage, fraction);
    report_.stages.push_back({std::string(stage), 0});
    started_ = std::chrono::steady_clock::now();
  }
  void stop() {
    if (report_.stages.empty()) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started_;
    report_.stages.back().seconds = elapsed.count();
  }

 private:
  const GenerateTetMeshOptions& options_;
  GenerateTetMeshReport& report_;
  std::chrono::steady_clock::time_point started_;
};

constexpr double kBandEdges = 2;  // how far from the surface phi must be exact

SizingOptions sizingOptions(const SignedDistance& phi, const GenerateTetMeshOptions& options) {
  if (!(options.edgeLength > 0) || !std::isfinite(options.edgeLength)) {
    throw std::invalid_argument("generateTetMesh: edgeLength must be a length above 0 mm");
  }
  if (phi.band() < kBandEdges * options.edgeLength) {
    throw std::invalid_argument("generateTetMesh: phi must be known up to two edge lengths from its surface");
  }
  SizingOptions sizing;
  sizing.edgeLength = options.edgeLength;
  sizing.maxEdgeLength = options.maxEdgeLength > 0 ? options.maxEdgeLength : 8 * options.edgeLength;
  sizing.minEdgeLength = std::min(phi.resolution(), options.edgeLength);
  sizing.curvature = options.curvature;
  if (options.curvature <= 0) sizing.thickness = 0;
  sizing.levels = options.levels;
  if (sizing.maxEdgeLength < sizing.edgeLength) {
    throw std::invalid_argument("generateTetMesh: maxEdgeLength must not be below edgeLength");
  }
  return sizing;
}

/// What a mesh must not exceed without the candidate giving way.
constexpr double kMaxAspectRatio = 4.2;
constexpr double kMinDihedralDeg = 20;
constexpr double kMaxDihedralDeg = 142;
constexpr int kMaxRetreats = 16;
constexpr int kGentleRetreats = 4;  // rounds that give up one node at each trouble; later ones give up all
constexpr int kRetreatRings = 4;    // rings of nodes around a retreat that move again

std::vector<Trouble> findTroubles(const TetMesh& mesh, const std::vector<std::int32_t>& latticeNodes,
                                  const std::vector<std::int32_t>& unsnapped) {
  std::vector<Trouble> troubles;
  for (const std::int32_t n : unsnapped) troubles.push_back({latticeNodes[n]});
  for (const Tet& tet : mesh.tets) {
    const TetQuality quality =
        tetQuality(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]);
    if (quality.aspectRatio <= kMaxAspectRatio && quality.minDihedralDeg >= kMinDihedralDeg &&
        quality.maxDihedralDeg <= kMaxDihedralDeg) {
      continue;
    }
    troubles.push_back(
        {latticeNodes[tet[0]], latticeNodes[tet[1]], latticeNodes[tet[2]], latticeNodes[tet[3]]});
  }
  return troubles;
}

/// Compresses; where nodes stay off the surface or tets stay bad, lets the candidate retreat there and
/// compresses the surroundings again.
TetMesh compressWithRetreats(const LatticeMesh& background, const NodeStars& stars, Candidate& candidate,
                             const SignedDistance& phi, const GenerateTetMeshOptions& options,
                             GenerateTetMeshReport& report) {
  const CompressionOptions compression{.edgeLength = options.edgeLength};
  std::vector<std::int32_t> latticeNodes;
  TetMesh mesh = extractMesh(background, candidate.keep, options.label, &latticeNodes);
  CompressionReport last = compressOntoSurface(mesh, phi, compression);
  while (!mesh.tets.empty()) {
    const std::vector<Trouble> troubles = findTroubles(mesh, latticeNodes, last.unsnapped);
    if (troubles.empty() || report.retreats == kMaxRetreats) break;
    ++report.retreats;
    const std::vector<std::int32_t> released =
        retreat(background, stars, candidate, troubles, report.retreats > kGentleRetreats);

    std::vector<Eigen::Vector3d> reached(background.positions.size());
    for (std::size_t n = 0; n < latticeNodes.size(); ++n) reached[latticeNodes[n]] = mesh.nodes[n];
    mesh = extractMesh(background, candidate.keep, options.label, &latticeNodes);
    std::vector<std::uint8_t> around(background.positions.size(), 0);
    for (const std::int32_t n : released) {
      for (const std::int32_t t : stars.of(n)) {
        for (const std::int32_t v : background.tets[t]) around[v] = 1;
      }
    }
    std::vector<std::uint8_t> region(mesh.nodes.size(), 0);
    for (std::size_t n = 0; n < latticeNodes.size(); ++n) {
      mesh.nodes[n] = reached[latticeNodes[n]];
      region[n] = around[latticeNodes[n]];
    }
    growRings(mesh, kRetreatRings, region);
    last = compressOntoSurface(mesh, phi, compression, region);
  }
  if (!last.unsnapped.empty()) {
    throw std::runtime_error(
        std::to_string(last.unsnapped.size()) +
        " boundary nodes cannot reach the surface without crushing tets; try a smaller edge length");
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.kinds[n] == NodeKind::Boundary) {
      report.maxBoundaryPhi = std::max(report.maxBoundaryPhi, std::abs(phi.value(mesh.nodes[n])));
    }
  }
  return mesh;
}

}  // namespace

TetMesh generateTetMesh(const SignedDistance& phi, const GenerateTetMeshOptions& options,
                        GenerateTetMeshReport* report) {
  GenerateTetMeshReport local;
  GenerateTetMeshReport& out = report != nullptr ? *report : local;
  out = {};
  const SizingOptions sizing = sizingOptions(phi, options);
  StageClock clock(options, out);

  clock.start("lattice", 0);
  const LatticePlan plan = planLattice(phi, sizing);
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, sizing);
  const LatticeMesh background = latticeMesh(lattice, plan, phi);
  out.latticeNodes = lattice.nodes().size();
  out.finestCube = plan.cubeSize(plan.levels - 1);

  clock.start("candidate", 0.3);
  const NodeStars stars = nodeStars(background.positions.size(), background.tets);
  Candidate candidate = selectCandidate(background, stars);
  out.repairPasses = candidate.passes;
  out.repairCapReached = candidate.violations > 0;
  if (out.repairCapReached) {
    throw std::runtime_error("no candidate under the conditions T1-T3 after " +
                             std::to_string(candidate.passes) + " repair passes; try a smaller edge length");
  }

  clock.start("compression", 0.5);
  TetMesh mesh = compressWithRetreats(background, stars, candidate, phi, options, out);
  clock.stop();
  if (options.progress) options.progress("compression", 1);
  return mesh;
}

double estimateMemory(const SignedDistance& phi, const GenerateTetMeshOptions& options) {
  (void)phi;
  (void)options;
  return 0;
}

}  // namespace sinew
