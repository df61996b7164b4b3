#include "sinew/Mesher/GenerateTetMesh.h"

#include "ActiveNodes.h"
#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Mesher/Sizing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
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
constexpr double kLargestRetreat = 0.1;  // fraction of the tets that may be given up, of large meshes
constexpr double kSmallMesh = 1000;      // tets below which a mesh may shrink to nothing
constexpr int kRetreatRings = 4;         // rings of nodes around a retreat that move again

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

/// The candidate on its way onto the surface, and what is wrong with it so far.
class Compaction {
 public:
  Compaction(const LatticeMesh& background, const NodeStars& stars, Candidate& candidate,
             const SignedDistance& phi, const GenerateTetMeshOptions& options)
      : background_(background),
        stars_(stars),
        candidate_(candidate),
        phi_(phi),
        label_(options.label),
        compression_{.edgeLength = options.edgeLength},
        mesh_(extractMesh(background, candidate.keep, options.label, &latticeNodes_)) {
    compress({});
  }

  const TetMesh& mesh() const { return mesh_; }
  const std::vector<Trouble>& troubles() const { return troubles_; }
  /// Whether every boundary node has reached the surface.
  std::size_t unsnapped() const { return unsnapped_; }

  /// Lets the candidate give way at the troubles and compresses the surroundings again.
  void giveWay(bool thoroughly) {
    const std::vector<std::int32_t> released =
        retreat(background_, stars_, candidate_, troubles_, thoroughly);
    std::vector<Eigen::Vector3d> reached(background_.positions.size());
    for (std::size_t n = 0; n < latticeNodes_.size(); ++n) reached[latticeNodes_[n]] = mesh_.nodes[n];
    mesh_ = extractMesh(background_, candidate_.keep, label_, &latticeNodes_);

    std::vector<std::uint8_t> around(background_.positions.size(), 0);
    for (const std::int32_t n : released) {
      for (const std::int32_t t : stars_.of(n)) {
        for (const std::int32_t v : background_.tets[t]) around[v] = 1;
      }
    }
    std::vector<std::uint8_t> region(mesh_.nodes.size(), 0);
    for (std::size_t n = 0; n < latticeNodes_.size(); ++n) {
      mesh_.nodes[n] = reached[latticeNodes_[n]];
      region[n] = around[latticeNodes_[n]];
    }
    growRings(mesh_, kRetreatRings, region);
    compress(region);
  }

 private:
  void compress(const std::vector<std::uint8_t>& region) {
    const CompressionReport report = compressOntoSurface(mesh_, phi_, compression_, region);
    unsnapped_ = report.unsnapped.size();
    troubles_ = findTroubles(mesh_, latticeNodes_, report.unsnapped);
  }

  const LatticeMesh& background_;
  const NodeStars& stars_;
  Candidate& candidate_;
  const SignedDistance& phi_;
  std::int32_t label_;
  CompressionOptions compression_;
  std::vector<std::int32_t> latticeNodes_;
  TetMesh mesh_;
  std::vector<Trouble> troubles_;
  std::size_t unsnapped_ = 0;
};

double maxBoundaryPhi(const TetMesh& mesh, const SignedDistance& phi) {
  double largest = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.kinds[n] == NodeKind::Boundary) largest = std::max(largest, std::abs(phi.value(mesh.nodes[n])));
  }
  return largest;
}

/// The best mesh on the surface among those that the retreats lead to.
TetMesh compressWithRetreats(const LatticeMesh& background, const NodeStars& stars, Candidate& candidate,
                             const SignedDistance& phi, const GenerateTetMeshOptions& options,
                             GenerateTetMeshReport& report) {
  Compaction compaction(background, stars, candidate, phi, options);
  const double smallest =
      (1 - kLargestRetreat) * static_cast<double>(compaction.mesh().tets.size()) - kSmallMesh;
  TetMesh best;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  while (true) {
    if (compaction.unsnapped() == 0 && compaction.troubles().size() < fewest) {
      fewest = compaction.troubles().size();
      best = compaction.mesh();
    }
    if (compaction.troubles().empty() || report.retreats == kMaxRetreats) break;
    compaction.giveWay(++report.retreats > kGentleRetreats);
    if (compaction.mesh().tets.empty() || static_cast<double>(compaction.mesh().tets.size()) < smallest)
      break;
  }
  if (fewest == std::numeric_limits<std::size_t>::max()) {
    throw std::runtime_error(
        std::to_string(compaction.unsnapped()) +
        " boundary nodes cannot reach the surface without crushing tets; try a smaller edge length");
  }
  report.maxBoundaryPhi = maxBoundaryPhi(best, phi);
  return best;
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
  constexpr double kNear = 0.5;        // a plane has about one cube centre this near, in cubes, per cube face
  constexpr double kSurfaceTets = 60;  // tets within the uniform layer, per area of one edge length squared
  constexpr double kInteriorTets = 12;  // tets per cube of the largest size
  constexpr double kBytesPerTet =
      400;  // measured at the peak of the compression, bits of the lattice included
  const SizingOptions sizing = sizingOptions(phi, options);
  const double cube = std::max(sizing.edgeLength, 0.5 * phi.band());
  const Eigen::AlignedBox3d box = phi.bounds();
  const Eigen::Array3i cells = (box.sizes() / cube).array().ceil().cast<int>();
  double surfaceCubes = 0, insideCubes = 0;
  for (int z = 0; z < cells.z(); ++z) {
    for (int y = 0; y < cells.y(); ++y) {
      for (int x = 0; x < cells.x(); ++x) {
        const double value = phi.value(box.min() + cube * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        surfaceCubes += std::abs(value) < kNear * cube;
        insideCubes += value < 0;
      }
    }
  }
  const double area = surfaceCubes * cube * cube, volume = insideCubes * cube * cube * cube;
  const double tets = kSurfaceTets * area / (sizing.edgeLength * sizing.edgeLength) +
                      kInteriorTets * volume / std::pow(sizing.maxEdgeLength, 3);
  return kBytesPerTet * tets;
}

}  // namespace sinew
