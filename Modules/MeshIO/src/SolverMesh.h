#pragma once

#include "sinew/MeshIO/QuadraticMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

#include <span>
#include <vector>

namespace sinew {

/// A face of a tet, opposite to its corner `face`.
struct TetFace {
  std::int32_t tet;
  int face;
};

/// The nodes of a face: three, counterclockwise from outside, or six: then the middles of the edges 01, 12
/// and 20.
class FaceNodes {
 public:
  FaceNodes(std::span<const std::int32_t> tet, int face);
  const std::int32_t* begin() const { return nodes_.data(); }
  const std::int32_t* end() const { return nodes_.data() + count_; }

 private:
  std::array<std::int32_t, 6> nodes_{};
  std::size_t count_;
};

/// What a solver's file says of one tissue.
struct SolverPart {
  const TissueRegion* region;
  std::vector<std::int32_t> tets;           ///< ascending
  std::vector<std::int32_t> nodes;          ///< of the tets, ascending
  std::vector<TetFace> boundary;            ///< faces without a tet of the same tissue behind them
  std::vector<std::int32_t> boundaryNodes;  ///< ascending
};

/// A mesh as the files of solvers hold it. It refers to the mesh that it was made from.
class SolverMesh {
 public:
  /// With options.quadratic the tets have ten nodes: the edges bend as `mesh.curvedEdges` say, or, where it
  /// names none, as curveBoundary finds.
  SolverMesh(const TissueMesh& mesh, const WriteMeshOptions& options);

  std::size_t nodeCount() const { return quadratic() ? quadraticNodes_.size() : mesh_.nodes.size(); }
  std::size_t tetCount() const { return mesh_.tets.size(); }
  bool quadratic() const { return !quadraticTets_.empty(); }
  /// In the file's space and unit.
  Eigen::Vector3d node(std::size_t n) const;
  /// Four nodes, or ten in the order of QuadraticTet.
  std::span<const std::int32_t> tet(std::size_t t) const;
  FaceNodes face(const TetFace& face) const { return {tet(static_cast<std::size_t>(face.tet)), face.face}; }
  /// The tissues that have tets, in the order of the regions.
  const std::vector<SolverPart>& parts() const { return parts_; }
  /// Those of the parts.
  std::vector<TissueRegion> regions() const;
  /// A positive number for every part: its label, or the first free one above all labels.
  std::vector<std::int32_t> tags() const;

 private:
  const TetMesh& mesh_;
  WriteMeshOptions options_;
  std::vector<Eigen::Vector3d> quadraticNodes_;
  std::vector<QuadraticTet> quadraticTets_;
  std::vector<SolverPart> parts_;
};

}  // namespace sinew
