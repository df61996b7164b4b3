#include "LocalRepair.h"

#include "KeptSet.h"
#include "NodeStarEnergy.h"
#include "Parallel.h"
#include "RepairSpot.h"
#include "sinew/Mesher/Compression.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace sinew {
namespace {

constexpr int kMaxRounds = 300;
constexpr int kMostRounds = 400;           // while there are grave spots
constexpr int kPatchRings = 2;             // rings of nodes around what has changed that move again
constexpr std::size_t kMostReleased = 64;  // nodes, in a trial
constexpr std::size_t kMostEnveloped = 8;
constexpr std::size_t kMostInner = 6;   // enveloped nodes that are given up in turn at a spot
constexpr std::size_t kMostOuter = 10;  // boundary nodes that are taken in in turn at a spot
constexpr double kWorstStart = 100;     // F with which a trial may begin
constexpr std::size_t kPatchGrain = 256;  // nodes of patches per task

using Nodes = std::vector<std::int32_t>;

/// What a trial changes: nodes to give up, or one to take in.
struct Choice {
  Nodes release;
  std::int32_t envelope = kNone;

  bool empty() const { return release.empty() && envelope == kNone; }
};

/// A trial: what was given up or taken in, and the nodes that move again.
struct Patch {
  Nodes key;                ///< the spot's nodes
  bool lastResort = false;  ///< stays even when it is no better: nothing else has helped
  Nodes released{};
  Nodes enveloped{};
  Nodes region{};
  std::vector<Eigen::Vector3d> former{};  ///< positions of the region's nodes before an enveloping trial
  Badness before{}, after{};
};

class LocalRepair {
 public:
  LocalRepair(const LatticeMesh& background, const NodeStars& stars, const Candidate& candidate,
              const SignedDistance& phi, const LocalRepairOptions& options)
      : background_(background),
        stars_(stars),
        phi_(phi),
        options_(options),
        set_(background, stars, candidate.enveloped),
        positions_(background.positions),
        patchOf_(background.positions.size(), kNone),
        nearPatch_(background.positions.size(), 0),
        isGrown_(background.positions.size(), 0),
        localOf_(background.positions.size(), kNone) {
    Nodes latticeNodes;
    TetMesh mesh = extractMesh(background, set_.keep(), options.label, &latticeNodes);
    const CompressionOptions compression{.edgeLength = options.edgeLength};
    const CompressionReport report = options.compressor ? options.compressor(mesh, phi, compression)
                                                        : compressOntoSurface(mesh, phi, compression);
    forEach(latticeNodes.size(), [&](std::size_t n) { positions_[latticeNodes[n]] = mesh.nodes[n]; });
    spots_ = repairSpots(mesh, latticeNodes, report.unsnapped, options.bounds);
  }

  void run(LocalRepairReport& report) {
    for (; report.rounds < (anyGrave() ? kMostRounds : kMaxRounds); ++report.rounds) {
      if (options_.tick) options_.tick();
      std::vector<Patch> patches = choosePatches();
      if (patches.empty()) break;
      report.tried += std::ssize(patches);
      report.accepted += tryPatches(patches);
    }
  }

  /// @throws std::runtime_error when a boundary node is off the surface
  TetMesh mesh() const {
    if (const auto off = nodesOffSurface(); off > 0)
      throw std::runtime_error(
          std::to_string(off) +
          " boundary nodes cannot reach the surface without crushing tets; try a smaller edge length");
    Nodes latticeNodes;
    TetMesh mesh = extractMesh(background_, set_.keep(), options_.label, &latticeNodes);
    forEach(latticeNodes.size(), [&](std::size_t n) { mesh.nodes[n] = positions_[latticeNodes[n]]; });
    return mesh;
  }

 private:
  bool anyGrave() const { return std::ranges::any_of(spots_, &Spot::grave); }
  std::ptrdiff_t nodesOffSurface() const {
    return std::ranges::count_if(spots_, [](const Spot& spot) { return spot.badness == kInfinity; });
  }

  /// Spots from the worst on, each with what is tried there next; patches that would touch wait for a later
  /// round.
  std::vector<Patch> choosePatches() {
    std::sort(spots_.begin(), spots_.end());
    std::vector<Patch> patches;
    Nodes around;  // of the patches chosen so far: a spot here would only give a patch that touches them
    for (const Spot& spot : spots_) {
      if (std::ranges::any_of(spot.nodes, [&](std::int32_t n) { return nearPatch_[n] != 0; })) continue;
      std::optional<Patch> patch = nextPatch(spot);
      if (!patch) continue;
      take(patch->region, static_cast<std::int32_t>(patches.size()));
      for (const std::int32_t n : grown(patch->region, kPatchRings)) {
        nearPatch_[n] = 1;
        around.push_back(n);
      }
      patches.push_back(std::move(*patch));
    }
    for (const std::int32_t n : around) nearPatch_[n] = 0;
    return patches;
  }

  /// Changes the set as the next possible trial at a spot wants; empty when all has been tried, or when the
  /// patch would touch another.
  std::optional<Patch> nextPatch(const Spot& spot) {
    std::size_t& trial = trials_[spot.nodes];
    while (true) {
      Choice choice = choiceAt(spot, trial);
      Patch patch{.key = spot.nodes, .lastResort = spot.grave && choice.empty()};
      if (patch.lastResort) choice = choiceAt(spot, 0);
      if (choice.empty()) return std::nullopt;
      change(choice, patch);
      if (isTaken(patch.region)) {
        putBack(patch);
        return std::nullopt;
      }
      const bool changed = !patch.released.empty() || !patch.enveloped.empty();
      if (changed && (patch.enveloped.empty() || relax(patch))) return patch;
      putBack(patch);
      if (patch.lastResort) return std::nullopt;
      ++trial;
    }
  }

  void change(const Choice& choice, Patch& patch) {
    if (choice.envelope != kNone) {
      patch.enveloped = envelopeNode(set_, choice.envelope, kMostEnveloped);
    } else if (patch.lastResort) {
      patch.released = releaseNodes(set_, choice.release);
    } else {
      patch.released = releaseNodes(set_, choice.release, kMostReleased);
    }
    patch.region = regionAround(patch.enveloped.empty() ? patch.released : patch.enveloped);
  }

  /// Moves the enveloped stars back to the lattice and the nodes around them part of the way: what was
  /// compressed without the new tets would invert them.
  /// @return whether no tet is inverted then
  bool relax(Patch& patch) {
    for (const std::int32_t n : patch.region) patch.former.push_back(positions_[n]);
    Nodes core = patch.enveloped;
    for (const std::int32_t n : patch.enveloped) addStar(n, true, core);
    sortUnique(core);
    for (int ring = kPatchRings - 1; ring >= 0; --ring) {
      const double kept = static_cast<double>(ring) / kPatchRings;
      for (const std::int32_t n : grown(core, ring)) {
        const auto at = std::ranges::lower_bound(patch.region, n) - patch.region.begin();
        positions_[n] = kept * patch.former[at] + (1 - kept) * background_.positions[n];
      }
    }
    return std::ranges::all_of(patch.region, [&](std::int32_t n) {
      return std::ranges::all_of(stars_.of(n), [&](std::int32_t t) {
        return !set_.isKept(t) || shapeMeasure(background_.tets[t], positions_) < kWorstStart;
      });
    });
  }

  bool isTaken(const Nodes& nodes) const {
    return std::ranges::any_of(nodes, [&](std::int32_t n) { return patchOf_[n] != kNone; });
  }
  void take(const Nodes& nodes, std::int32_t patch) {
    for (const std::int32_t n : nodes) patchOf_[n] = patch;
  }

  /// What is given up at a spot in the k-th trial: its shallowest enveloped node; that of all spots around
  /// too; all the nodes at the spot; then one after the other. After these its boundary nodes are taken in,
  /// one after the other. Empty when all has been tried.
  Choice choiceAt(const Spot& spot, std::size_t trial) {
    const Nodes inner = envelopedAt(spot);
    const std::size_t releases = inner.empty() ? 0 : inner.size() + 2;
    if (trial >= releases) {
      const Nodes outer = boundaryAt(spot);
      return trial - releases < outer.size() ? Choice{{}, outer[trial - releases]} : Choice{};
    }
    if (trial == 0) return {{inner[0]}};
    if (trial == 1) return {shallowestAround(inner[0])};
    if (trial == 2) return {inner};
    return {{inner[trial - 2]}};
  }

  /// The boundary nodes at a spot, those of the bad tet itself first; of each kind that whose star reaches
  /// out least.
  Nodes boundaryAt(const Spot& spot) const {
    Nodes around;
    for (const std::int32_t n : spot.nodes) addStar(n, true, around);
    sortUnique(around);
    std::vector<std::tuple<bool, double, std::int32_t>> found;
    for (const std::int32_t n : around) {
      if (set_.isBoundary(n) && !set_.isEnveloped(n))
        found.emplace_back(std::ranges::find(spot.nodes, n) == spot.nodes.end(), set_.outsideCost(n), n);
    }
    std::ranges::sort(found);
    Nodes nodes;
    for (const auto& [beside, cost, v] : std::span(found).first(std::min(kMostOuter, found.size())))
      nodes.push_back(v);
    return nodes;
  }

  /// The enveloped nodes of the tets at a spot, the shallowest first.
  Nodes envelopedAt(const Spot& spot) const {
    std::vector<std::pair<double, std::int32_t>> found;
    for (const std::int32_t n : spot.nodes) {
      for (const std::int32_t t : stars_.of(n)) {
        for (const std::int32_t v : background_.tets[t]) {
          if (set_.isEnveloped(v)) found.emplace_back(-background_.phi[v], v);
        }
      }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    Nodes nodes;
    for (const auto& [depth, v] : std::span(found).first(std::min(kMostInner, found.size())))
      nodes.push_back(v);
    return nodes;
  }

  Nodes shallowestAround(std::int32_t node) {
    const Nodes around = regionAround({node});
    Nodes nodes;
    for (const Spot& spot : spots_) {
      const bool near = std::ranges::any_of(
          spot.nodes, [&](std::int32_t n) { return std::ranges::binary_search(around, n); });
      const Nodes choices = near ? envelopedAt(spot) : Nodes{};
      if (!choices.empty()) nodes.push_back(choices.front());
    }
    sortUnique(nodes);
    return nodes;
  }

  void putBack(const Patch& patch) {
    for (const std::int32_t n : patch.released) set_.envelope(n);
    for (const std::int32_t n : patch.enveloped) set_.release(n);
    for (std::size_t n = 0; n < patch.former.size(); ++n) positions_[patch.region[n]] = patch.former[n];
  }

  /// The nodes within a few rings of what has changed.
  Nodes regionAround(const Nodes& changed) {
    Nodes region = changed;
    for (const std::int32_t n : changed) addStar(n, false, region);
    sortUnique(region);
    return grown(std::move(region), kPatchRings);
  }

  /// With the nodes of kept tets a few rings further.
  Nodes grown(Nodes nodes, int rings) {
    for (const std::int32_t n : nodes) isGrown_[n] = 1;
    for (std::size_t begin = 0; rings > 0; --rings) {
      const std::size_t end = nodes.size();
      for (; begin < end; ++begin) {
        for (const std::int32_t t : stars_.of(nodes[begin])) {
          if (!set_.isKept(t)) continue;
          for (const std::int32_t v : background_.tets[t])
            if (std::exchange(isGrown_[v], std::uint8_t{1}) == 0) nodes.push_back(v);
        }
      }
    }
    for (const std::int32_t n : nodes) isGrown_[n] = 0;
    std::ranges::sort(nodes);
    return nodes;
  }

  void addStar(std::int32_t n, bool keptOnly, Nodes& nodes) const {
    for (const std::int32_t t : stars_.of(n)) {
      if (keptOnly && !set_.isKept(t)) continue;
      const Tet& tet = background_.tets[t];
      nodes.insert(nodes.end(), tet.begin(), tet.end());
    }
  }

  /// Compresses all patches at once and puts back those that are not better.
  /// @return how many are better
  std::int64_t tryPatches(std::vector<Patch>& patches) {
    for (const Spot& spot : spots_) {
      if (const std::int32_t p = patchAt(spot.nodes); p != kNone) patches[p].before.add(spot);
    }
    Nodes latticeNodes;
    TetMesh local = localMesh(patches, latticeNodes);
    std::vector<std::uint8_t> region(latticeNodes.size());
    forEach(
        region.size(), [&](std::size_t n) { region[n] = isInner(latticeNodes[n]); }, kPatchGrain);
    const CompressionReport report =
        compressOntoSurface(local, phi_, {.edgeLength = options_.edgeLength}, region);
    const std::vector<Spot> found = repairSpots(local, latticeNodes, report.unsnapped, options_.bounds);
    for (const Spot& spot : found) {
      if (const std::int32_t p = patchAt(spot.nodes); p != kNone) patches[p].after.add(spot);
    }

    std::int64_t accepted = 0;
    std::vector<std::uint8_t> better(patches.size());
    for (std::size_t p = 0; p < patches.size(); ++p) {
      better[p] = patches[p].after < patches[p].before || patches[p].lastResort;
      accepted += better[p];
      if (better[p] != 0) continue;
      putBack(patches[p]);
      ++trials_[patches[p].key];
    }
    const auto isBetter = [&](std::int32_t p) { return p != kNone && better[p] != 0; };
    std::erase_if(spots_, [&](const Spot& spot) { return isBetter(patchAt(spot.nodes)); });
    for (const Spot& spot : found)
      if (isBetter(patchAt(spot.nodes))) spots_.push_back(spot);
    for (std::size_t n = 0; n < latticeNodes.size(); ++n)
      if (isBetter(patchOf_[latticeNodes[n]])) positions_[latticeNodes[n]] = local.nodes[n];
    for (const Patch& patch : patches) take(patch.region, kNone);
    return accepted;
  }

  /// The patch that moves one of the nodes, or kNone.
  std::int32_t patchAt(const Nodes& nodes) const {
    for (const std::int32_t n : nodes)
      if (isInner(n)) return patchOf_[n];
    return kNone;
  }

  /// Whether all kept tets of a node lie within its patch, so that none of another patch moves with it.
  bool isInner(std::int32_t n) const {
    if (patchOf_[n] == kNone) return false;
    return std::ranges::all_of(stars_.of(n), [&](std::int32_t t) {
      return !set_.isKept(t) || std::ranges::all_of(background_.tets[t], [&](std::int32_t v) {
        return patchOf_[v] == patchOf_[n];
      });
    });
  }

  std::int32_t firstInPatch(const Tet& tet) const {
    return *std::ranges::find_if(tet, [&](std::int32_t v) { return patchOf_[v] != kNone; });
  }

  /// The kept tets that have a node in a patch, at the present positions.
  TetMesh localMesh(const std::vector<Patch>& patches, Nodes& latticeNodes) {
    Nodes tets;
    for (const Patch& patch : patches) {
      for (const std::int32_t n : patch.region) {
        for (const std::int32_t t : stars_.of(n)) {
          if (set_.isKept(t) && n == firstInPatch(background_.tets[t])) tets.push_back(t);
        }
      }
    }
    std::ranges::sort(tets);

    TetMesh mesh;
    for (const std::int32_t t : tets) {
      Tet tet = background_.tets[t];
      for (std::int32_t& v : tet) {
        if (localOf_[v] == kNone) {
          localOf_[v] = static_cast<std::int32_t>(latticeNodes.size());
          latticeNodes.push_back(v);
          mesh.nodes.push_back(positions_[v]);
          mesh.kinds.push_back(set_.isBoundary(v) ? NodeKind::Boundary : NodeKind::Interior);
        }
        v = localOf_[v];
      }
      mesh.tets.push_back(tet);
    }
    for (const std::int32_t n : latticeNodes) localOf_[n] = kNone;
    mesh.labels.assign(mesh.tets.size(), options_.label);
    return mesh;
  }

  const LatticeMesh& background_;
  const NodeStars& stars_;
  const SignedDistance& phi_;
  const LocalRepairOptions& options_;
  KeptSet set_;
  std::vector<Eigen::Vector3d> positions_;  ///< of the lattice nodes, as compressed so far
  Nodes patchOf_;                           ///< lattice node -> patch of the present round, or kNone
  std::vector<std::uint8_t> nearPatch_;     ///< scratch of choosePatches
  std::vector<std::uint8_t> isGrown_;       ///< scratch of grown
  Nodes localOf_;                           ///< scratch of localMesh
  std::vector<Spot> spots_;
  std::map<Nodes, std::size_t> trials_;  ///< spot -> choices that did not help
};

}  // namespace

TetMesh compressAndRepair(const LatticeMesh& background, const NodeStars& stars, const Candidate& candidate,
                          const SignedDistance& phi, const LocalRepairOptions& options,
                          LocalRepairReport* report) {
  LocalRepairReport local;
  LocalRepair repair(background, stars, candidate, phi, options);
  repair.run(report != nullptr ? *report : local);
  return repair.mesh();
}

}  // namespace sinew
