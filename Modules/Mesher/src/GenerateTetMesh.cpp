#include "sinew/Mesher/GenerateTetMesh.h"

#include "LocalRepair.h"
#include "NodeStarEnergy.h"
#include "Parallel.h"
#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/Sizing.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
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

constexpr double kMostGreen = 0.2;   // part of the tets: the mean aspect ratio stays near 2
constexpr double kBandEdges = 1.55;  // how far from the surface phi must be exact

void requireThat(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("generateTetMesh: ") + what);
}

SizingOptions sizingOptions(const SignedDistance& phi, const GenerateTetMeshOptions& options) {
  requireThat(options.edgeLength > 0 && std::isfinite(options.edgeLength),
              "edgeLength must be a length above 0 mm");
  requireThat(options.maxEdgeLength >= 0 && std::isfinite(options.maxEdgeLength),
              "maxEdgeLength must be a length or 0");
  requireThat(options.maxEdgeLength == 0 || options.maxEdgeLength >= options.edgeLength,
              "maxEdgeLength must not be below edgeLength");
  requireThat(options.curvature >= 0, "curvature must not be negative");
  requireThat(options.minEdgeLength >= 0 && std::isfinite(options.minEdgeLength),
              "minEdgeLength must be a length or 0");
  requireThat(options.tolerance >= 0 && std::isfinite(options.tolerance), "tolerance must be a length or 0");
  requireThat(options.levels >= 0, "levels must not be negative");
  requireThat(phi.band() >= kBandEdges * options.edgeLength,
              "phi must be known up to 1.55 edge lengths from its surface");
  SizingOptions sizing;
  sizing.edgeLength = options.edgeLength;
  sizing.maxEdgeLength = options.maxEdgeLength > 0 ? options.maxEdgeLength : 8 * options.edgeLength;
  const double smallest = options.minEdgeLength > 0 ? options.minEdgeLength : phi.resolution();
  sizing.minEdgeLength = std::min(smallest, options.edgeLength);
  sizing.curvature = options.curvature;
  sizing.tolerance = options.tolerance;
  if (options.curvature <= 0) sizing.thickness = 0;
  sizing.levels = options.levels;
  return sizing;
}

/// The part of the tets with a node inside that are green.
double greenShare(const LatticeMesh& mesh) {
  constexpr double kRedShape = 1.16;  // F of a BCC tet is 125/108
  std::int64_t inside = 0, green = 0;
  for (const Tet& tet : mesh.tets) {
    const auto [a, b, c, d] = tet;
    if (std::min(std::min(mesh.phi[a], mesh.phi[b]), std::min(mesh.phi[c], mesh.phi[d])) >= 0) continue;
    ++inside;
    green += shapeMeasure(tet, mesh.positions) > kRedShape;
  }
  return inside > 0 ? static_cast<double>(green) / static_cast<double>(inside) : 0;
}

/// Green tets are the worse part of the family: where they would be too many, the whole surface gets the
/// cubes that some of it asks for.
LatticeMesh latticeFor(const SignedDistance& phi, const SizingOptions& sizing,
                       GenerateTetMeshReport& report) {
  LatticePlan plan = planLattice(phi, sizing);
  while (true) {
    RedGreenLattice lattice(plan.coarseCells, plan.levels);
    const int finest = refineToSize(lattice, plan, phi, sizing);
    report.finestCube = plan.cubeSize(finest);
    report.latticeNodes = lattice.nodes().size();
    LatticeMesh mesh = latticeMesh(lattice, plan, phi);
    if (finest <= plan.surfaceLevel || greenShare(mesh) <= kMostGreen) return mesh;
    ++plan.surfaceLevel;
  }
}

double maxBoundaryPhi(const TetMesh& mesh, const SignedDistance& phi) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.nodes.size(), kBlock), 0.0,
      [&](const auto& range, double largest) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
          if (mesh.kinds[n] == NodeKind::Boundary)
            largest = std::max(largest, std::abs(phi.value(mesh.nodes[n])));
        }
        return largest;
      },
      [](double a, double b) { return std::max(a, b); });
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
  const LatticeMesh background = latticeFor(phi, sizing, out);

  clock.start("candidate", 0.3);
  const NodeStars stars = nodeStars(background.positions.size(), background.tets);
  const Candidate candidate = selectCandidate(background, stars);
  out.repairPasses = candidate.passes;
  out.nodesReleased = candidate.released;

  clock.start("compression", 0.5);
  LocalRepairReport repair;
  const auto tick = [&] {
    if (options.progress) options.progress("compression", 0.8);
  };
  TetMesh mesh =
      compressAndRepair(background, stars, candidate, phi,
                        {.edgeLength = options.edgeLength,
                         .label = options.label,
                         .compressor = options.compressor,
                         .bounds = options.repair,
                         .tick = tick},
                        &repair);
  out.patchesTried = repair.tried;
  out.patchesMended = repair.accepted;
  out.maxBoundaryPhi = maxBoundaryPhi(mesh, phi);
  clock.stop();
  if (options.progress) options.progress("compression", 1);
  return mesh;
}

double estimateMemory(const SignedDistance& phi, const GenerateTetMeshOptions& options) {
  constexpr double kNear = 0.5;        // a plane has about one cube centre this near, in cubes, per cube face
  constexpr double kSurfaceTets = 60;  // tets within the uniform layer, per area of one edge length squared
  constexpr double kInteriorTets = 12;  // tets per cube of the largest size
  const SizingOptions sizing = sizingOptions(phi, options);
  constexpr double kSamplesAcross = 64;  // at least, in a shape that is known everywhere
  const Eigen::AlignedBox3d box = phi.bounds();
  const double cube =
      std::max(sizing.edgeLength, std::min(0.5 * phi.band(), box.sizes().maxCoeff() / kSamplesAcross));
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
