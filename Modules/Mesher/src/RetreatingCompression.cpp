#include "RetreatingCompression.h"

#include "ActiveNodes.h"
#include "GoalMeasure.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/MeshQuality.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

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
  const auto& x = mesh.nodes;
  for (const Tet& tet : mesh.tets) {
    if (goalMeasure(x[tet[3]], x[tet[0]], x[tet[1]], x[tet[2]]) <= 1) continue;
    const TetQuality quality = tetQuality(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]);
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
             const SignedDistance& phi, const RetreatingCompressionOptions& options)
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

}  // namespace

TetMesh compressWithRetreats(const LatticeMesh& background, const NodeStars& stars, Candidate& candidate,
                             const SignedDistance& phi, const RetreatingCompressionOptions& options,
                             int& retreats) {
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
    if (compaction.troubles().empty() || retreats == kMaxRetreats) break;
    compaction.giveWay(++retreats > kGentleRetreats);
    if (compaction.mesh().tets.empty() || static_cast<double>(compaction.mesh().tets.size()) < smallest)
      break;
  }
  if (fewest == std::numeric_limits<std::size_t>::max()) {
    throw std::runtime_error(
        std::to_string(compaction.unsnapped()) +
        " boundary nodes cannot reach the surface without crushing tets; try a smaller edge length");
  }
  return best;
}

}  // namespace sinew
