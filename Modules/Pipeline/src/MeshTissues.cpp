#include "sinew/Pipeline/MeshTissues.h"

#include "MeshOneTissue.h"
#include "ProgressSum.h"
#include "TissueCost.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Pipeline/SelectTissues.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sinew {
namespace {

constexpr double kUsableMemory = 0.9;  // of what is available: other programs live too

double checkedLength(Length length, double voxel, const std::string& what) {
  const double mm = length.millimetres(voxel);
  if (!(mm > 0))
    throw std::invalid_argument(what + " is " + toString(length) + ", but must be larger than 0");
  return mm;
}

/// The sizes of every tissue, with the wishes of the user resolved.
std::vector<TissueSizes> resolveSizes(const Segmentation& segmentation, const MeshTissuesOptions& options) {
  const double voxel = segmentation.geometry.meanSpacing();
  std::vector<double> edges(segmentation.tissues.size(),
                            checkedLength(options.edgeLength, voxel, "the edge length"));
  for (const auto& [wish, length] : options.sizes)
    for (const int tissue : selectTissues(segmentation, {wish}))
      edges[tissue] = checkedLength(length, voxel, "the edge length of '" + wish + "'");
  const double maximum = options.maxEdgeLength.millimetres(voxel);
  if (!(maximum >= 0))
    throw std::invalid_argument("the largest edge length is " + toString(options.maxEdgeLength) +
                                ", but must not be negative");
  std::vector<TissueSizes> sizes;
  for (const double edge : edges) sizes.push_back({edge, maximum > 0 ? std::max(maximum, edge) : 8 * edge});
  return sizes;
}

/// How many tissues may be in flight, when the largest come first.
/// @throws std::invalid_argument when not even the largest fits.
int tissuesInFlight(const Segmentation& segmentation, const std::vector<TissueJob>& jobs, double available) {
  const TissueJob& largest = jobs.front();
  const Tissue& tissue = segmentation.tissues[largest.tissue];
  if (largest.cost.memory > available) {
    const double fitting =
        std::ceil(100 * largest.sizes.edge * std::sqrt(largest.cost.memory / available)) / 100;
    const std::string remedy = largest.cost.ofVoxels > available / 2
                                   ? "; use a smaller edge length"
                                   : "; use " + toString(fitting) + " or more";
    throw std::invalid_argument(segmentation.source + ": '" + tissue.name + "' at edge length " +
                                toString(largest.sizes.edge) + " would take about " +
                                formatBytes(largest.cost.memory) + " of memory, but " +
                                formatBytes(available) + " is available" + remedy);
  }
  const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  double memory = 0;
  int count = 0;
  for (const TissueJob& job : jobs) {
    memory += job.cost.memory;
    if (memory > available || count == static_cast<int>(threads)) break;
    ++count;
  }
  return count;
}

/// How large a tissue is, mm.
struct Extent {
  double largest;  ///< longest side of its box
  double mean;     ///< side of the cube of its volume
};

Extent extentOf(const ImageGeometry& geometry, const Tissue& tissue) {
  const Eigen::Vector3d sides =
      (tissue.box.upper - tissue.box.lower).cast<double>().cwiseProduct(geometry.spacing);
  return {sides.maxCoeff(), std::cbrt(static_cast<double>(tissue.voxels) * geometry.voxelVolume())};
}

/// A cube larger than the tissue stands for nothing. Who asks for cubes of two voxels or less, as by default,
/// wants to see specks too: they get three cubes along their mean extent.
TissueSizes fittingSizes(const Extent& extent, double voxel, const TissueSizes& wanted) {
  constexpr double kFineVoxels = 2 * (1 + 1e-9), kCubesAlong = 3;
  const double edge =
      std::min(wanted.edge, wanted.edge <= kFineVoxels * voxel ? extent.mean / kCubesAlong : extent.largest);
  return {edge, std::max(edge, std::min(wanted.largest, extent.largest))};
}

/// The mesher looks for the surface up to 1.55 edge lengths away; samples much finer than the lattice buy
/// nothing, but a speck is sampled more finely than its voxels.
LevelSetFromLabelsOptions levelSetOptions(const ImageGeometry& geometry, double meanExtent, double edgeLength,
                                          LevelSetFromLabelsOptions options) {
  constexpr double kBandEdges = 1.6, kSamplesPerEdge = 5, kSamplesAlong = 12, kFinestSpeck = 1.0 / 3;
  const double voxel = defaultGridSpacing(geometry);
  if (options.gridSpacing <= 0)
    options.gridSpacing = std::max(
        {edgeLength / kSamplesPerEdge, kFinestSpeck * voxel, std::min(voxel, meanExtent / kSamplesAlong)});
  options.bandVoxels = std::max(options.bandVoxels, kBandEdges * edgeLength / options.gridSpacing);
  return options;
}

TissueJob makeJob(const Segmentation& segmentation, int index, const TissueSizes& wanted,
                  const MeshTissuesOptions& options) {
  const Tissue& tissue = segmentation.tissues[index];
  TissueJob job;
  job.tissue = index;
  const Extent extent = extentOf(segmentation.geometry, tissue);
  job.sizes = fittingSizes(extent, segmentation.geometry.meanSpacing(), wanted);
  job.sizeReduced = job.sizes.edge < wanted.edge;
  job.levelSet = levelSetOptions(segmentation.geometry, extent.mean, job.sizes.edge, options.levelSet);
  job.cost = estimateCost(segmentation, tissue, job.sizes, job.levelSet);
  return job;
}

std::vector<TissueJob> jobsLargestFirst(const Segmentation& segmentation, const std::vector<int>& tissues,
                                        const MeshTissuesOptions& options) {
  const std::vector<TissueSizes> sizes = resolveSizes(segmentation, options);
  const std::vector<std::string> stems = tissueFileStems(segmentation.tissues);
  std::vector<TissueJob> jobs(tissues.size());
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
    jobs[j] = makeJob(segmentation, tissues[j], sizes[tissues[j]], options);
    jobs[j].slot = j;
    jobs[j].file = stems[tissues[j]] + ".vtu";
  });
  // Largest need of memory first; the stable sort keeps ties in the order of the table.
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const TissueJob& a, const TissueJob& b) { return a.cost.memory > b.cost.memory; });
  return jobs;
}

}  // namespace

std::vector<TissueReport> meshTissues(const Segmentation& segmentation, const std::vector<int>& tissues,
                                      const std::filesystem::path& folder, const MeshTissuesOptions& options,
                                      const TissueProgress& progress) {
  if (tissues.empty()) return {};
  const std::vector<TissueJob> jobs = jobsLargestFirst(segmentation, tissues, options);
  const double available = kUsableMemory * availableMemory();
  const int inFlight = tissuesInFlight(segmentation, jobs, available);

  std::vector<double> work(jobs.size());
  for (const TissueJob& job : jobs) work[job.slot] = job.cost.work;
  ProgressSum sum(work, progress);
  std::vector<TissueReport> reports(jobs.size());
  std::size_t next = 0;
  const auto nextJob = [&](tbb::flow_control& flow) -> std::size_t {
    if (next < jobs.size() && !sum.stopped()) return next++;
    flow.stop();
    return next;
  };
  const auto runJob = [&](std::size_t j) {
    // Without the isolation a thread that waits for its own loops would begin another tissue, beyond
    // `inFlight`.
    tbb::this_task_arena::isolate([&] {
      try {
        reports[jobs[j].slot] = meshOneTissue(segmentation, jobs[j], folder, options, available, sum);
      } catch (const ProgressSum::Stopped&) {
        // Leave by the pipeline's end: an exception here would cancel the loops of the other tissues
        // half-way.
      }
    });
  };
  tbb::parallel_pipeline(inFlight,
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, nextJob) &
                             tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, runJob));
  sum.rethrow();
  return reports;
}

}  // namespace sinew
