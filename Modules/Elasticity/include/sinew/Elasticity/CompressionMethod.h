#pragma once

#include "sinew/Elasticity/PhysicsCompression.h"
#include "sinew/Mesher/GenerateTetMesh.h"

#include <memory>

namespace sinew {

/// How a candidate mesh is fitted to the surface.
enum class CompressionMethod {
  Optimization,    ///< compressOntoSurface
  Springs,         ///< compressByPhysics, and optimization where a tet is beyond kPhysicsBounds
  FiniteElements,  ///< the same with finite elements
  Hybrid,          ///< finite elements, then optimization everywhere
};

/// What a mesh made by physics alone must keep: the best of Teran et al. 2005, section 7, but for the aspect
/// ratio, which is 6.5 there.
inline constexpr TetBounds kPhysicsBounds{5, 17, 147};

/// What the methods with physics did to a candidate.
struct CompressionMethodReport {
  PhysicsCompressionReport physics;
  std::int64_t mendedTets = 0;   ///< tets beyond the bounds after physics
  std::int64_t mendedNodes = 0;  ///< nodes near them, or off the surface, that optimization moved
};

/// Makes generateTetMesh compress by a method.
/// @param physics  its `forces` follow the method
/// @param report  filled when generateTetMesh runs, if not null; must live until then
/// @throws std::invalid_argument on options out of range
void compressBy(CompressionMethod method, const PhysicsCompressionOptions& physics,
                GenerateTetMeshOptions& options, CompressionMethodReport* report = nullptr);

}  // namespace sinew
