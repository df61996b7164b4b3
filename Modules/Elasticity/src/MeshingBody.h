#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <cstdint>

namespace sinew {

/// The part of a candidate mesh that moves when its boundary is driven.
struct MeshingBody {
  ElasticBody body;
  std::vector<std::int32_t> meshNodes;  ///< of the body's nodes
  std::vector<std::uint8_t> moves;      ///< per body node; the others are held
  std::vector<double> sizes;            ///< least altitude of the tets around each body node at rest, mm
  std::vector<std::int32_t> boundary;   ///< body nodes on the boundary of the mesh
};

/// The tets around the nodes up to `rings` rings below the boundary. Tets have the density
/// modulus crossing^2 / altitude^2 with altitude their least one, so that a wave takes the same time through
/// each: one time step serves cubes of all sizes.
/// @param crossing  that time, s
/// @param modulus  of the waves, kPa
MeshingBody meshingBody(const TetMesh& mesh, int rings, double crossing, double modulus);

}  // namespace sinew
