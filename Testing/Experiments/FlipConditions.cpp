// Takes from a mesh what T2 and T3 ask for, and nothing else: the same nodes, the same boundary, every tet positive and
// of good shape, but interior edges between boundary nodes and tets with four boundary nodes. For what the conditions
// are worth in a simulation, see README.md.
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <span>
#include <vector>

namespace sinew {
namespace {

struct Options {
  std::string input, output;
  double maxAspectRatio = 4;   ///< of a tet that a flip makes
  double minDihedralDeg = 20;  ///< likewise
};

using Nodes = std::vector<std::int32_t>;
using Edge = std::array<std::int32_t, 2>;

/// Flips that make an edge between two boundary nodes: the tets around an edge, or the two at a face, make room for others
/// that fill the same space.
class Flipper {
 public:
  Flipper(TetMesh& mesh, const Options& options) : mesh_(mesh), options_(options) {
    const MeshBoundary boundary = meshBoundary(mesh);
    onBoundary_.assign(mesh.nodes.size(), false);
    for (const Triangle& triangle : boundary.triangles)
      for (const std::int32_t n : triangle) onBoundary_[static_cast<std::size_t>(n)] = true;
  }

  /// Every tet takes part in one flip at most. @return flips
  int run() {
    used_.assign(mesh_.tets.size(), false);
    int flips = 0;
    for (const auto& [edge, tets] : tetsAtEdges())
      if (tets.size() == 4) flips += flipEdge(edge, tets);
    for (const auto& [face, tets] : tetsAtFaces())
      if (tets.size() == 2) flips += flipFace(face, tets);
    return flips;
  }

 private:
  using Tets = std::vector<std::size_t>;

  std::map<Edge, Tets> tetsAtEdges() const {
    std::map<Edge, Tets> result;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const auto& [i, j] : kTetEdges) {
        const auto [low, high] = std::minmax(mesh_.tets[t][i], mesh_.tets[t][j]);
        result[{low, high}].push_back(t);
      }
    return result;
  }

  std::map<Triangle, Tets> tetsAtFaces() const {
    std::map<Triangle, Tets> result;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const auto& face : kTetFaces) {
        Triangle key{mesh_.tets[t][face[0]], mesh_.tets[t][face[1]], mesh_.tets[t][face[2]]};
        std::ranges::sort(key);
        result[key].push_back(t);
      }
    return result;
  }

  bool isFree(const Tets& tets) const {
    return std::ranges::none_of(tets, [&](std::size_t t) { return used_[t]; });
  }
  bool onBoundary(std::int32_t n) const { return onBoundary_[static_cast<std::size_t>(n)]; }

  /// The nodes of tets that are none of those given, each once.
  Nodes others(const Tets& tets, std::span<const std::int32_t> given) const {
    Nodes result;
    for (const std::size_t t : tets)
      for (const std::int32_t n : mesh_.tets[t])
        if (std::ranges::find(given, n) == given.end() && std::ranges::find(result, n) == result.end())
          result.push_back(n);
    return result;
  }

  bool share(const Tets& tets, std::int32_t a, std::int32_t b) const {
    return std::ranges::any_of(tets, [&](std::size_t t) {
      const Tet& tet = mesh_.tets[t];
      return std::ranges::find(tet, a) != tet.end() && std::ranges::find(tet, b) != tet.end();
    });
  }

  /// Four tets around p q with the ring r0 r1 r2 r3: four others around a diagonal of the ring.
  bool flipEdge(const Edge& edge, const Tets& tets) {
    const Nodes ring = others(tets, edge);
    if (ring.size() != 4 || !isFree(tets)) return false;  // else the edge is on the boundary
    for (std::size_t last = 1; last < 4; ++last) {
      const std::int32_t a = ring[0], b = ring[last];
      if (share(tets, a, b)) continue;
      const std::int32_t c = ring[last % 3 + 1], d = ring[(last + 1) % 3 + 1];
      for (const auto& [from, to, left, right] : {std::array{a, b, c, d}, std::array{c, d, a, b}}) {
        if (!onBoundary(from) || !onBoundary(to)) continue;
        if (replace(tets, {{from, to, left, edge[0]},
                           {from, to, left, edge[1]},
                           {from, to, right, edge[0]},
                           {from, to, right, edge[1]}}))
          return true;
      }
    }
    return false;
  }

  /// Two tets at a face: three around the edge through it.
  bool flipFace(const Triangle& face, const Tets& tets) {
    if (!isFree(tets)) return false;
    const Nodes tips = others(tets, face);
    if (tips.size() != 2 || !onBoundary(tips[0]) || !onBoundary(tips[1])) return false;
    std::vector<Tet> made;
    for (int f = 0; f < 3; ++f) made.push_back({tips[0], tips[1], face[f], face[(f + 1) % 3]});
    return replace(tets, made);
  }

  /// Where the new tets fill the same space and are good enough.
  bool replace(const Tets& tets, std::vector<Tet> made) {
    const auto quality = [&](const Tet& tet) {
      const auto at = [&](int c) -> const Eigen::Vector3d& {
        return mesh_.nodes[static_cast<std::size_t>(tet[c])];
      };
      return tetQuality(at(0), at(1), at(2), at(3));
    };
    double before = 0, after = 0;
    for (const std::size_t t : tets) before += quality(mesh_.tets[t]).volume;
    for (Tet& tet : made) {
      if (quality(tet).volume < 0) std::swap(tet[2], tet[3]);
      const TetQuality q = quality(tet);
      if (q.aspectRatio > options_.maxAspectRatio || q.minDihedralDeg < options_.minDihedralDeg) return false;
      after += q.volume;
    }
    constexpr double kRounding = 1e-9;
    if (std::abs(after - before) > kRounding * before) return false;  // they overlap: the space is not convex
    for (const std::size_t t : tets) used_[t] = true;
    for (std::size_t i = 0; i < made.size(); ++i)
      if (i < tets.size()) {
        mesh_.tets[tets[i]] = made[i];
      } else {
        mesh_.tets.push_back(made[i]);
        mesh_.labels.push_back(mesh_.labels[tets[0]]);
        used_.push_back(true);
      }
    return true;
  }

  TetMesh& mesh_;
  const Options& options_;
  std::vector<bool> onBoundary_, used_;
};

void run(const Options& options) {
  TissueMesh mesh = readMesh(options.input);
  const int flips = Flipper(mesh.mesh, options).run();
  mesh.arrays = {};
  writeMesh(mesh, options.output);
  const MeshConditions conditions = meshConditions(mesh.mesh);
  const MeshQuality quality = meshQuality(mesh.mesh);
  std::cout << "{\"flips\": " << flips << ", \"tets\": " << quality.tets
            << ", \"t2\": " << conditions.tetsWithFourBoundaryNodes
            << ", \"t3\": " << conditions.interiorEdgesBetweenBoundaryNodes << ", \"nonmanifold\": "
            << conditions.nonmanifoldEdges + conditions.nonmanifoldNodes + conditions.facesOfManyTets
            << ", \"max_aspect_ratio\": " << quality.maxAspectRatio
            << ", \"min_dihedral_deg\": " << quality.minDihedralDeg << ", \"inverted\": " << quality.inverted
            << ", \"volume_mm3\": " << quality.volume << "}\n";
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  sinew::Options options;
  CLI::App app("Flips tets of a mesh so that T2 and T3 are violated: same nodes, same boundary, good tets.");
  app.add_option("INPUT", options.input, "mesh")->required();
  app.add_option("OUTPUT", options.output, "mesh to write")->required();
  app.add_option("--max-aspect-ratio", options.maxAspectRatio, "of a tet that a flip makes")
      ->capture_default_str();
  app.add_option("--min-dihedral", options.minDihedralDeg, "of a tet that a flip makes, degrees")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    sinew::run(options);
  } catch (const std::exception& error) {
    std::cerr << "flipConditions: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
