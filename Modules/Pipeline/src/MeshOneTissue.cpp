#include "MeshOneTissue.h"

#include "LevelSetSurface.h"
#include "MeasureFidelity.h"
#include "OffsetSurface.h"
#include "sinew/MeshIO/VtuFile.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/LabelComponents.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <new>
#include <numeric>
#include <stdexcept>

namespace sinew {
namespace {

/// Fractions of a tissue's work done at the end of each stage, for the progress bar.
constexpr double kAfterLevelSet = 0.2, kAfterMesh = 0.9, kAfterMeasure = 0.97;

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

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

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
    report_.label = tissue_.label;
    report_.layer = tissue_.layer;
    report_.edgeLength = job.sizes.edge;
  }

  void run(const std::filesystem::path& folder) {
    const TetMesh mesh = generate();
    if (mesh.tets.empty()) return lose();
    measure(mesh);
    const std::string wrong = unsoundness(report_.quality, report_.conditions);
    if (!wrong.empty()) throw std::runtime_error("the mesh is unsound and was not written: " + wrong);
    advance("writing", kAfterMeasure);
    OutputFile output(folder / job_.file);
    writeVtu(mesh, output.temporary());
    output.commit();
    lap("writing");
    report_.file = job_.file;
    report_.status = TissueStatus::Meshed;
    report_.message = warning();
  }

  TissueReport& report() { return report_; }
  void advance(const std::string& stage, double fraction) {
    progress_.report(job_.slot, tissue_.name, stage, fraction);
  }

 private:
  /// The mesh in LPS; leaves the level set behind for measure().
  TetMesh generate() {
    advance("level set", 0);
    LevelSet levelSet = levelSetFromLabels(segmentation_, tissue_, job_.levelSet, &volumes_);
    frame_ = levelSet.frame;
    surface_ = std::make_unique<LevelSetSurface>(levelSet);
    levelSet.grid.reset();
    lap("level set");

    GenerateTetMeshOptions options;
    options.edgeLength = job_.sizes.edge;
    options.maxEdgeLength = job_.sizes.largest;
    options.curvature = options_.curvature;
    options.levels = options_.levels;
    options.label = tissue_.label;
    options.progress = [this](std::string_view stage, double fraction) {
      advance(std::string(stage), kAfterLevelSet + fraction * (kAfterMesh - kAfterLevelSet));
    };
    const double memory = estimateMemory(*surface_, options);
    if (memory > availableMemory_)
      throw std::runtime_error("the mesh would take about " + formatBytes(memory) + " of memory, but " +
                               formatBytes(availableMemory_) + " is available; use a larger edge length");
    advance("lattice", kAfterLevelSet);
    TetMesh mesh = generateOn(*surface_, options);
    surfaceOffset_ = offsetForVolume(mesh);
    if (surfaceOffset_ > 0) {
      options.progress = [this](std::string_view, double) { advance("keeping the volume", kAfterMesh); };
      mesh = generateOn(OffsetSurface(*surface_, surfaceOffset_), options);
    }
    watch_.lap();
    for (Eigen::Vector3d& node : mesh.nodes) node = frame_ * node;
    return mesh;
  }

  TetMesh generateOn(const SignedDistance& surface, const GenerateTetMeshOptions& options) {
    GenerateTetMeshReport mesher;
    TetMesh mesh = generateTetMesh(surface, options, &mesher);
    for (const auto& [stage, seconds] : mesher.stages) addSeconds(stage, seconds);
    return mesh;
  }

  /// Flat triangles cut off what is round: where a mesh misses a noticeable part of the volume, its target is
  /// moved outwards by what is missing over its area, mm.
  double offsetForVolume(const TetMesh& mesh) const {
    constexpr double kNoticeable = 0.01;     // of the volume
    constexpr double kLargestOffset = 0.05;  // edge lengths
    const double missing = volumes_.levelSetVolume - meshVolume(mesh);
    if (mesh.tets.empty() || missing <= kNoticeable * volumes_.levelSetVolume) return 0;
    return std::min(missing / boundaryArea(mesh), kLargestOffset * job_.sizes.edge);
  }

  void measure(const TetMesh& mesh) {
    advance("measuring", kAfterMesh);
    report_.quality = meshQuality(mesh);
    const MeshBoundary boundary = meshBoundary(mesh);
    report_.conditions = meshConditions(mesh, boundary);
    report_.topology = meshTopology(mesh, boundary);
    const LevelSetTopology topology = levelSetTopology(*surface_);
    report_.levelSetComponents = topology.components;
    report_.levelSetEuler = topology.eulerCharacteristic;
    const FidelityReport fidelity =
        measureFidelity(mesh, boundary.triangles, OffsetSurface(*surface_, surfaceOffset_), frame_, volumes_,
                        segmentation_, tissue_);
    report_.fidelity = fidelity.fidelity;
    report_.fidelity.surfaceOffset = surfaceOffset_;
    report_.lost = fidelity.lost;
    surface_.reset();
    lap("measuring");
  }

  void lose() {
    report_.status = TissueStatus::Lost;
    report_.fidelity.labelVolume = volumes_.labelVolume;
    report_.fidelity.levelSetVolume = volumes_.levelSetVolume;
    report_.lost.components =
        static_cast<std::int64_t>(labelComponents(segmentation_, tissue_).voxels.size());
    report_.lost.volume = volumes_.labelVolume;
    report_.message = "too small for the lattice: " + std::to_string(tissue_.voxels) + " voxels, " +
                      number(volumes_.labelVolume) + " mm^3, at edge length " + number(job_.sizes.edge) +
                      " mm; a smaller --size may keep it";
  }

  std::string warning() const {
    constexpr double kLargeVolumeError = 0.2;
    std::vector<std::string> parts;
    if (job_.sizeReduced)
      parts.push_back("edge length reduced to " + number(job_.sizes.edge) +
                      " mm, to fit the tissue");
    const double ratio = report_.fidelity.volume / report_.fidelity.labelVolume;
    if (std::abs(ratio - 1) > kLargeVolumeError)
      parts.push_back("volume is " + number(100 * ratio) + " % of the label's; a smaller --size may help");
    if (report_.lost.components > 0)
      parts.push_back(std::to_string(report_.lost.components) +
                      (report_.lost.components == 1 ? " piece" : " pieces") + " of " +
                      number(report_.lost.volume) + " mm^3 in all too small to keep");
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
    return text;
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
  if (report.file.empty()) {
    std::error_code ignored;
    std::filesystem::remove(folder / job.file, ignored);
  }
  run.advance("done", 1);
  return report;
}

}  // namespace sinew
