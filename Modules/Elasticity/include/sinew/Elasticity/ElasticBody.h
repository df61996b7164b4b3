#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

/// Units of this module: mm, kg, s. Forces are then mN, stresses and moduli kPa, energies uJ, and water has
/// the density 1e-6 kg/mm^3.
namespace sinew {

using NodeVectors = std::vector<Eigen::Vector3d>;  ///< places, velocities or forces, one per node

/// What a mesh is to elasticity: tets with their shape at rest, nodes with their mass.
struct ElasticBody {
  NodeVectors rest;                           ///< mm
  std::vector<Tet> tets;                      ///< all positive at rest
  std::vector<Eigen::Matrix3d> inverseEdges;  ///< Dm^-1, Dm = (x1 - x0, x2 - x0, x3 - x0) at rest, 1/mm
  std::vector<double> volumes;                ///< at rest, mm^3
  std::vector<double> masses;                 ///< kg per node, a quarter of that of each tet around it
  std::vector<std::int32_t> firstCorner;      ///< node n has corners[firstCorner[n]] up to firstCorner[n + 1]
  std::vector<std::int32_t> corners;          ///< 4 * tet + place in the tet

  std::size_t nodeCount() const { return rest.size(); }
};

/// The mesh as it stands is the shape at rest.
/// @param density  kg/mm^3, positive
/// @throws std::invalid_argument naming the first tet that is not positive; a density that is not.
/// Cost: O(tets).  Source: Teran et al. 2005, section 7 (lumped masses).
ElasticBody elasticBody(const TetMesh& mesh, double density = 1e-6);

/// F = Ds Dm^-1 of a tet with its nodes at `places`; det F <= 0 for an inverted one.
Eigen::Matrix3d deformationGradient(const ElasticBody& body, const NodeVectors& places, std::size_t tet);

/// The least det F of all tets: volume now over volume at rest. 1 for a body without tets.
double leastVolumeRatio(const ElasticBody& body, const NodeVectors& places);

}  // namespace sinew
