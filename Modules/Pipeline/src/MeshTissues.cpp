#include "sinew/Pipeline/MeshTissues.h"

#include "EdgeLengthSearch.h"
#include "MeshOneTissue.h"
#include "ProgressSum.h"
#include "TissueCost.h"
#include "sinew/MeshIO/CombineMeshes.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Segmentation/SelectTissues.h"

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

void checkNotNegative(Length length, const std::string& what) {
  if (!(length.value >= 0))
    throw std::invalid_argument(what + " is " + toString(length) + ", but must not be negative");
}

/// What every tissue is to have, with the wishes of the user resolved.
std::vector<TissueWish> resolveWishes(const Segmentation& segmentation, const MeshTissuesOptions& options) {
  const double voxel = segmentation.geometry.meanSpacing();
  const double edge = checkedLength(options.edgeLength, voxel, "the edge length");
  std::vector<TissueWish> wanted(segmentation.tissues.size(), {edge, false, options.smoothing});
  for (const auto& [wish, length] : options.sizes)
    for (const int tissue : selectTissues(segmentation, {wish})) {
      wanted[tissue].edge = checkedLength(length, voxel, "the edge length of '" + wish + "'");
      wanted[tissue].ownEdge = true;
    }
  for (const auto& [wish, smoothing] : options.smoothings)
    for (const int tissue : selectTissues(segmentation, {wish})) wanted[tissue].smoothing = smoothing;
  return wanted;
}

void checkOptions(const MeshTissuesOptions& options) {
  checkNotNegative(options.maxEdgeLength, "the largest edge length");
  checkNotNegative(options.minEdgeLength, "the smallest edge length");
  checkNotNegative(options.tolerance, "the tolerance");
  if (options.targetTets < 0)
    throw std::invalid_argument("the number of tets is " + std::to_string(options.targetTets) +
                                ", but must not be negative");
  requireSound(options.physics);
}

/// How many tissues may be in flight, when the largest come first.
/// @throws std::invalid_argument when not even the largest fits.
int tissuesInFlight(const Segmentation& segmentation, const std::vector<TissueJob>& jobs, double available) {
  const TissueJob& largest = jobs.front();
  const Tissue& tissue = segmentation.tissues[largest.tissue];
  if (largest.cost.memory > available) {
    const double fitting =
        std::ceil(100 * largest.plan.sizes.edge * std::sqrt(largest.cost.memory / available)) / 100;
    const std::string remedy = largest.cost.ofVoxels > available / 2
                                   ? "; use a smaller edge length"
                                   : "; use " + toString(fitting) + " or more";
    throw std::invalid_argument(segmentation.source + ": '" + tissue.name + "' at edge length " +
                                toString(largest.plan.sizes.edge) + " would take about " +
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

TissueJob makeJob(const Segmentation& segmentation, int index, const TissueWish& wanted,
                  const MeshTissuesOptions& options) {
  const Tissue& tissue = segmentation.tissues[index];
  TissueJob job;
  job.tissue = index;
  job.searchSize = options.targetTets > 0 && !wanted.ownEdge;
  const double volume = static_cast<double>(tissue.voxels) * segmentation.geometry.voxelVolume();
  const auto firstTrial = [&] {
    return firstEdgeLength(surfaceArea(segmentation, tissue), volume, options.targetTets);
  };
  job.wish = wanted;
  if (job.searchSize) job.wish.edge = firstTrial();
  job.plan = job.searchSize ? planTrial(segmentation, tissue, job.wish, options)
                            : planTissue(segmentation, tissue, job.wish, options);
  job.cost = estimateCost(segmentation, tissue, job.plan.sizes, job.plan.levelSet);
  return job;
}

std::vector<TissueJob> jobsLargestFirst(const Segmentation& segmentation, const std::vector<int>& tissues,
                                        bool withFiles, const MeshTissuesOptions& options) {
  checkOptions(options);
  const std::vector<TissueWish> wishes = resolveWishes(segmentation, options);
  const std::vector<std::string> stems = tissueFileStems(segmentation.tissues);
  std::vector<TissueJob> jobs(tissues.size());
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
    jobs[j] = makeJob(segmentation, tissues[j], wishes[tissues[j]], options);
    jobs[j].slot = j;
    if (withFiles) jobs[j].file = stems[tissues[j]] + options.extension;
  });
  // Largest need of memory first; the stable sort keeps ties in the order of the table.
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const TissueJob& a, const TissueJob& b) { return a.cost.memory > b.cost.memory; });
  return jobs;
}

/// One mesh of those that there are; says in the reports which label each has there.
TissueMesh combine(std::vector<TissueMesh> meshes, std::vector<TissueReport>& reports) {
  std::vector<TissueMesh> parts;
  std::vector<TissueReport*> owners;
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    if (meshes[n].mesh.tets.empty()) continue;
    parts.push_back(std::move(meshes[n]));
    owners.push_back(&reports[n]);
  }
  TissueMesh all = combineMeshes(std::move(parts));
  for (std::size_t n = 0; n < owners.size(); ++n) owners[n]->combinedLabel = all.regions[n].label;
  return all;
}

}  // namespace

std::vector<TissueReport> meshTissues(const Segmentation& segmentation, const std::vector<int>& tissues,
                                      const std::filesystem::path& folder, const MeshTissuesOptions& options,
                                      const TissueProgress& progress, TissueMesh* combined) {
  if (tissues.empty()) return {};
  std::vector<TissueJob> jobs = jobsLargestFirst(segmentation, tissues, !folder.empty(), options);
  std::vector<TissueMesh> kept(combined != nullptr ? jobs.size() : 0);
  if (combined != nullptr)
    for (TissueJob& job : jobs) job.kept = &kept[job.slot];
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
  if (combined != nullptr) *combined = combine(std::move(kept), reports);
  return reports;
}

}  // namespace sinew
