#include "MeshOneTissue.h"

#include "Digits.h"
#include "EdgeLengthSearch.h"
#include "LevelSetSurface.h"
#include "MeasureFidelity.h"
#include "NearestSurfacePoint.h"
#include "OffsetSurface.h"
#include "QualityArrays.h"
#include "TissueLevelSet.h"
#include "TopologyDifferences.h"
#include "UnderResolution.h"
#include "VolumeOffset.h"
#include "WorstElements.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Mesher/MoveBoundary.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Pipeline/MethodSettings.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/LabelComponents.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sinew {
namespace {

/// Fractions of a tissue's work done at the end of each stage, for the progress bar.
constexpr double kAfterMesh = 0.9, kAfterMeasure = 0.97;
constexpr double kLevelSetShare = 0.22;  // of the work for a mesh

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string oneLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// What is unsound about a mesh; empty when nothing is.
std::string unsoundness(const MeshQuality& quality, const MeshConditions& conditions) {
  const std::pair<std::int64_t, const char*> counts[]{
      {quality.inverted, "inverted tets"},
      {conditions.facesOfManyTets, "faces of three or more tets"},
      {conditions.nonmanifoldEdges, "non-manifold edges"},
      {conditions.nonmanifoldNodes, "non-manifold nodes"},
      {conditions.tetsWithFourBoundaryNodes, "tets with four boundary nodes"},
      {conditions.interiorEdgesBetweenBoundaryNodes, "interior edges between boundary nodes"},
      {conditions.interiorFacesWithThreeBoundaryNodes, "interior faces with three boundary nodes"}};
  std::string text;
  for (const auto& [count, what] : counts)
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  return text;
}

/// The steps of one tissue, with what they share.
class TissueRun {
 public:
  TissueRun(const Segmentation& segmentation, const TissueJob& job, const MeshTissuesOptions& options,
            double availableMemory, ProgressSum& progress)
      : segmentation_(segmentation),
        tissue_(segmentation.tissues[job.tissue]),
        job_(job),
        options_(options),
        availableMemory_(availableMemory),
        progress_(progress) {
    report_.name = tissue_.name;
    report_.id = tissue_.id;
    report_.label = tissue_.label;
    report_.layer = tissue_.layer;
    report_.color = tissue_.color;
    report_.edgeLength = job.plan.sizes.edge;
  }

  void run(const std::filesystem::path& folder) {
    TissueMesh made;
    made.mesh = generate();
    if (made.mesh.tets.empty()) return lose();
    measure(made.mesh);
    const std::string wrong = unsoundness(report_.quality, report_.conditions);
    if (!wrong.empty()) throw std::runtime_error("the mesh is unsound and was not written: " + wrong);
    advance("writing", kAfterMeasure);
    made.regions = {{tissue_.label, tissue_.name, tissue_.color}};
    if (options_.withQuality) made.arrays = qualityArrays(made.mesh, *surface_, frame_);
    if (options_.writing.quadratic) made.curvedEdges = curvedEdges(made.mesh);
    surface_.reset();
    if (!job_.file.empty()) write(made, folder / job_.file);
    if (job_.kept != nullptr) *job_.kept = std::move(made);
    report_.status = TissueStatus::Meshed;
    report_.message = warning();
  }

  void write(const TissueMesh& mesh, const std::filesystem::path& file) {
    OutputFile output(file);
    writeMesh(mesh, output.temporary(), options_.writing);
    output.commit();
    report_.file = job_.file;
    lap("writing");
  }

  TissueReport& report() { return report_; }
  void advance(const std::string& stage, double fraction) {
    progress_.report(job_.slot, tissue_.name, stage, fraction);
  }

 private:
  /// The mesh in LPS; leaves the level set behind for measure().
  TetMesh generate() {
    Attempt attempt = job_.searchSize ? searchEdgeLength() : attemptWith(job_.plan, kAfterMesh);
    if (attempt.plan.thinnest < attempt.plan.sizes.smallest && losesThinParts(attempt))
      refineThinParts(attempt);
    TetMesh mesh = keepVolume(std::move(attempt));
    watch_.lap();
    for (Eigen::Vector3d& node : mesh.nodes) node = frame_ * node;
    return mesh;
  }

  struct Made {
    TetMesh mesh;
    TissueCompression compression;
  };

  /// A mesh in the level set's frame, and what it was made from.
  struct Attempt {
    TissuePlan plan;
    LevelSetFromLabelsReport volumes;
    SmoothingReport smoothing;
    Eigen::Isometry3d frame;
    std::unique_ptr<LevelSetSurface> surface;
    Made made;
  };

  /// @param share  of the tissue's work, for the progress
  Attempt attemptWith(const TissuePlan& plan, double share) {
    Attempt attempt;
    attempt.plan = plan;
    advance("level set", done_);
    {
      const TissueLevelSet made = makeTissueLevelSet(segmentation_, tissue_, plan);
      attempt.volumes = made.volumes;
      attempt.smoothing = made.smoothing;
      attempt.frame = made.levelSet.frame;
      attempt.surface = std::make_unique<LevelSetSurface>(made.levelSet);
    }
    lap("level set");
    const double first = done_ + share * kLevelSetShare, last = done_ + share;
    GenerateTetMeshOptions options = mesherOptions(plan);
    options.progress = [&](std::string_view stage, double fraction) {
      advance(std::string(stage), first + fraction * (last - first));
    };
    const double memory = estimateMemory(*attempt.surface, options);
    if (memory > availableMemory_)
      throw std::runtime_error("the mesh would take about " + formatBytes(memory) + " of memory, but " +
                               formatBytes(availableMemory_) + " is available; use a larger edge length");
    advance("lattice", first);
    attempt.made = generateOn(*attempt.surface, options);
    watch_.lap();
    done_ = last;
    return attempt;
  }

  static double volumeError(const Attempt& attempt) {
    return std::abs(meshVolume(attempt.made.mesh) / attempt.volumes.levelSetVolume - 1);
  }
  /// Without curvature and tolerance nothing is refined.
  bool losesThinParts(const Attempt& attempt) const {
    constexpr double kMostLost = 0.01;
    return (options_.curvature > 0 || options_.tolerance.value > 0) && volumeError(attempt) > kMostLost;
  }

  /// Meshes once more with the smallest cubes that the plan allows, and takes what keeps the volume better.
  void refineThinParts(Attempt& attempt) {
    // Thin parts are sheets: their tets grow with the square of the refinement.
    const double finerBy = attempt.plan.sizes.smallest / attempt.plan.thinnest;
    const double memory =
        kBytesPerTet * static_cast<double>(attempt.made.mesh.tets.size()) * finerBy * finerBy;
    if (memory > availableMemory_) return;

    Attempt finer;
    finer.plan = attempt.plan;
    finer.plan.sizes.smallest = attempt.plan.thinnest;
    finer.volumes = attempt.volumes;
    GenerateTetMeshOptions options = mesherOptions(finer.plan);
    options.progress = [this](std::string_view, double) { advance("refining thin parts", kAfterMesh); };
    try {
      finer.made = generateOn(*attempt.surface, options);
    } catch (const std::exception&) {
      return;  // no mesh with smaller cubes: the one before stands
    }
    if (volumeError(finer) >= volumeError(attempt)) return;
    attempt.plan = finer.plan;
    attempt.made = std::move(finer.made);
  }

  /// Meshes until one has the wanted number of tets; the best one.
  Attempt searchEdgeLength() {
    const double share = kAfterMesh / kMostSizeTrials;
    std::vector<SizeTrial> trials;
    Attempt best;
    std::optional<double> edge = job_.plan.sizes.edge;
    while (edge) {
      TissueWish wish = job_.wish;
      wish.edge = *edge;
      const TissuePlan plan = planTrial(segmentation_, tissue_, wish, options_);
      const bool tried = std::ranges::count(trials, plan.sizes.edge, &SizeTrial::edge) > 0;
      if (tried) break;  // the tissue allows no larger edge length
      Attempt attempt;
      try {
        attempt = attemptWith(plan, share);
      } catch (const std::exception&) {
        if (trials.empty()) throw;
        break;  // too much memory, or no mesh at this edge length: what was found before stands
      }
      trials.push_back({plan.sizes.edge, std::ssize(attempt.made.mesh.tets)});
      if (bestTrial(trials, options_.targetTets) + 1 == trials.size()) best = std::move(attempt);
      edge = nextEdgeLength(trials, options_.targetTets);
    }
    return best;
  }

  /// Moves the boundary as far as the volume asks; the best mesh. Leaves the level set behind.
  TetMesh keepVolume(Attempt attempt) {
    volumes_ = attempt.volumes;
    report_.smoothing = attempt.smoothing;
    frame_ = attempt.frame;
    surface_ = std::move(attempt.surface);
    plan_ = attempt.plan;
    report_.edgeLength = plan_.sizes.edge;
    report_.minEdgeLength = plan_.sizes.smallest;
    TetMesh mesh = std::move(attempt.made.mesh);
    report_.compression = attempt.made.compression;
    // Edges that bend to the level set keep its volume better than straight ones that are moved outwards.
    const bool bends = options_.writing.quadratic && !options_.preserveVolume;
    if (mesh.tets.empty() || bends) return mesh;

    const double area = boundaryArea(mesh);
    const OffsetTrial plain{0, meshVolume(mesh)};
    KeptVolume best = tryOffsets(plain, area, [&](double offset) {
      Made moved{mesh, report_.compression};
      moved.mesh.nodes = moveBoundary(mesh, *surface_, offset);
      return moved;
    });
    const VolumeRule& rule = volumeRule(options_.preserveVolume);
    const double wanted = volumes_.levelSetVolume;
    if (rule.remesh && !goodVolume(best.trial, wanted, rule)) {
      GenerateTetMeshOptions options = mesherOptions(plan_);
      options.progress = [this](std::string_view, double) { advance("keeping the volume", kAfterMesh); };
      KeptVolume remeshed = tryOffsets(
          plain, area, [&](double offset) { return generateOn(OffsetSurface(*surface_, offset), options); });
      if (bestTrial({best.trial, remeshed.trial}, wanted) == 1) best = std::move(remeshed);
    }
    surfaceOffset_ = best.trial.offset;
    if (best.trial.offset == 0) return mesh;
    report_.compression = best.made.compression;
    return std::move(best.made.mesh);
  }

  /// The best of some meshes, and its volume; no mesh at offset 0.
  struct KeptVolume {
    OffsetTrial trial;
    Made made;
  };

  /// @param meshAt  makes the mesh whose boundary lies at an offset, mm
  KeptVolume tryOffsets(const OffsetTrial& plain, double area,
                        const std::function<Made(double)>& meshAt) const {
    const VolumeRule& rule = volumeRule(options_.preserveVolume);
    const double wanted = volumes_.levelSetVolume;
    std::vector<OffsetTrial> trials{plain};
    KeptVolume best{plain, {}};
    while (const auto offset = nextOffset(trials, wanted, area, plan_.sizes.edge, rule)) {
      Made made;
      try {
        made = meshAt(*offset);
      } catch (const std::exception&) {
        break;  // no mesh on the moved surface: the best so far stands
      }
      trials.push_back({*offset, meshVolume(made.mesh)});
      if (bestTrial(trials, wanted) + 1 == trials.size()) best = {trials.back(), std::move(made)};
    }
    return best;
  }

  GenerateTetMeshOptions mesherOptions(const TissuePlan& plan) const {
    const double voxel = segmentation_.geometry.meanSpacing();
    GenerateTetMeshOptions options;
    options.edgeLength = plan.sizes.edge;
    options.maxEdgeLength = plan.sizes.largest;
    options.minEdgeLength = plan.sizes.smallest;
    options.curvature = options_.curvature;
    options.tolerance = options_.tolerance.millimetres(voxel);
    options.levels = options_.levels;
    options.label = tissue_.label;
    return options;
  }

  Made generateOn(const SignedDistance& surface, GenerateTetMeshOptions options) {
    Made made;
    compressBy(options_.method, options_.physics, options, &made.compression.method);
    GenerateTetMeshReport mesher;
    made.mesh = generateTetMesh(surface, options, &mesher);
    made.compression.patchesTried = mesher.patchesTried;
    made.compression.patchesMended = mesher.patchesMended;
    for (const auto& [stage, seconds] : mesher.stages) addSeconds(stage, seconds);
    return made;
  }

  void measure(const TetMesh& mesh) {
    advance("measuring", kAfterMesh);
    report_.quality = meshQuality(mesh);
    report_.worst = worstElements(mesh, report_.quality);
    const MeshBoundary boundary = meshBoundary(mesh);
    report_.conditions = meshConditions(mesh, boundary);
    report_.topology = meshTopology(mesh, boundary);
    const LevelSetTopology topology = levelSetTopology(*surface_);
    report_.levelSetComponents = topology.components;
    report_.levelSetEuler = topology.eulerCharacteristic;
    compareTopology(mesh);
    const FidelityReport fidelity = measureFidelity(
        mesh, boundary.triangles, {.phi = *surface_, .offset = surfaceOffset_, .frame = frame_}, volumes_,
        segmentation_, tissue_);
    report_.fidelity = fidelity.fidelity;
    report_.lost = fidelity.lost;
    lap("measuring");
  }

  /// The edges of the boundary, bent to the level set; counted in the report.
  std::vector<CurvedEdge> curvedEdges(const TetMesh& mesh) {
    const Eigen::Isometry3d toSurface = frame_.inverse();
    CurvedBoundary curved =
        curveBoundary(mesh, [&](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
          const auto point = nearestSurfacePoint(*surface_, surfaceOffset_, toSurface * x);
          if (!point) return std::nullopt;
          return frame_ * *point;
        });
    std::vector<CurvedEdge> edges = std::exchange(curved.edges, {});
    report_.curved = std::move(curved);
    return edges;
  }

  void compareTopology(const TetMesh& mesh) {
    report_.topologyDifferences = topologyDifferences(mesh, *surface_, frame_);
    report_.topologyDifferenceCount = std::ssize(report_.topologyDifferences);
    if (report_.topologyDifferences.size() > kListedTopologyDifferences)
      report_.topologyDifferences.resize(kListedTopologyDifferences);
    const double smallest = std::min(plan_.sizes.smallest, plan_.sizes.edge);
    for (TopologyDifference& difference : report_.topologyDifferences)
      difference.reason = difference.width < smallest
                              ? "narrower than the smallest cubes allowed, " + threeDigits(smallest) + " mm"
                              : "the cubes there are too large";
  }

  void lose() {
    report_.status = TissueStatus::Lost;
    report_.fidelity.labelVolume = volumes_.labelVolume;
    report_.fidelity.levelSetVolume = volumes_.levelSetVolume;
    report_.lost.components =
        static_cast<std::int64_t>(labelComponents(segmentation_, tissue_).voxels.size());
    report_.lost.volume = volumes_.labelVolume;
    report_.message =
        "too small for the lattice: " + std::to_string(tissue_.voxels) + " voxels, " +
        threeDigits(volumes_.labelVolume) + " mm^3, at edge length " + threeDigits(plan_.sizes.edge) +
        " mm; try " +
        sizeOption(tissue_.name, std::min(plan_.sizes.edge / 2, std::cbrt(volumes_.labelVolume) / 3));
  }

  std::string warning() const {
    std::string text;
    const auto add = [&](const std::string& part) {
      if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
    };
    if (plan_.sizeReduced && !job_.searchSize)
      add("edge length reduced to " + threeDigits(plan_.sizes.edge) + " mm, to fit the tissue");
    if (job_.searchSize && !hasTets(report_.quality.tets, options_.targetTets))
      add(std::to_string(report_.quality.tets) + " tets at edge length " + threeDigits(plan_.sizes.edge) +
          " mm are as near as the search came to " + std::to_string(options_.targetTets));
    add(underResolution(report_));
    add(smoothingWarning(report_.smoothing));
    add(volumeWarning());
    add(methodWarning());
    return text;
  }

  std::string methodWarning() const {
    constexpr double kMostMended = 0.3;
    const double share = static_cast<double>(report_.compression.method.mendedNodes) /
                         static_cast<double>(std::max<std::int64_t>(report_.quality.nodes, 1));
    if (share <= kMostMended) return "";
    return "after " + toString(options_.method) + ", optimization had to mend " + threeDigits(100 * share) +
           " % of the nodes; a smaller --edge-length or --method hybrid may serve better";
  }

  std::string volumeWarning() const {
    constexpr double kLargeSmoothingError = 0.2;
    const Fidelity& fidelity = report_.fidelity;
    const double error = std::abs(fidelity.volume / fidelity.levelSetVolume - 1);
    if (options_.preserveVolume && error > kExactVolume.tolerance)
      return "the volume could only be brought within " + threeDigits(100 * error) + " %";
    if (std::abs(fidelity.levelSetVolume / fidelity.labelVolume - 1) > kLargeSmoothingError)
      return "volume is " + threeDigits(100 * fidelity.volume / fidelity.labelVolume) +
             " % of the label's; a smaller --smoothing may help";
    return "";
  }

  void lap(const std::string& stage) { addSeconds(stage, watch_.lap()); }

  void addSeconds(const std::string& stage, double seconds) {
    const auto same = std::ranges::find(report_.seconds, stage, &std::pair<std::string, double>::first);
    if (same != report_.seconds.end())
      same->second += seconds;
    else
      report_.seconds.emplace_back(stage, seconds);
  }

  const Segmentation& segmentation_;
  const Tissue& tissue_;
  const TissueJob& job_;
  const MeshTissuesOptions& options_;
  double availableMemory_;
  ProgressSum& progress_;
  Stopwatch watch_;
  double done_ = 0;  ///< of the tissue's work, so far
  TissuePlan plan_;
  Eigen::Isometry3d frame_;
  double surfaceOffset_ = 0;
  LevelSetFromLabelsReport volumes_;
  std::unique_ptr<LevelSetSurface> surface_;
  TissueReport report_;
};

}  // namespace

TissueReport meshOneTissue(const Segmentation& segmentation, const TissueJob& job,
                           const std::filesystem::path& folder, const MeshTissuesOptions& options,
                           double availableMemory, ProgressSum& progress) {
  TissueRun run(segmentation, job, options, availableMemory, progress);
  TissueReport& report = run.report();
  try {
    run.run(folder);
  } catch (const std::bad_alloc&) {
    report.message = "out of memory";
  } catch (const std::exception& error) {
    report.message = oneLine(error.what());
  }
  if (report.file.empty() && !job.file.empty()) {
    std::error_code ignored;
    std::filesystem::remove(folder / job.file, ignored);
  }
  run.advance("done", 1);
  return report;
}

}  // namespace sinew
