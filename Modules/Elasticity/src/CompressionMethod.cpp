#include "sinew/Elasticity/CompressionMethod.h"

#include "sinew/Mesher/MendCompression.h"

namespace sinew {
namespace {

/// A little inside of the bounds, so that what is written with fewer digits keeps them too.
constexpr TetBounds kMended{4.95, 17.2, 146.8};

CompressionReport physicsAndMending(TetMesh& mesh, const SignedDistance& phi,
                                    const CompressionOptions& options,
                                    const PhysicsCompressionOptions& physics,
                                    CompressionMethodReport& report) {
  report.physics = compressByPhysics(mesh, phi, options, physics);
  const MendReport mended = mendCompression(mesh, phi, options, kMended);
  report.mendedTets = mended.tets;
  report.mendedNodes = mended.nodes;
  return mended.compression;
}

}  // namespace

void compressBy(CompressionMethod method, const PhysicsCompressionOptions& physics,
                GenerateTetMeshOptions& options, CompressionMethodReport* report) {
  if (method == CompressionMethod::Optimization) return;
  requireSound(physics);
  PhysicsCompressionOptions chosen = physics;
  chosen.forces =
      method == CompressionMethod::Springs ? MeshingForces::Springs : MeshingForces::FiniteElements;
  const auto filled = [report](const CompressionMethodReport& done) {
    if (report != nullptr) *report = done;
  };
  if (method == CompressionMethod::Hybrid) {
    options.compressor = [=](TetMesh& mesh, const SignedDistance& phi,
                             const CompressionOptions& compression) {
      filled({.physics = compressByPhysics(mesh, phi, compression, chosen)});
      return compressOntoSurface(mesh, phi, compression);
    };
    return;
  }
  options.repair = {kMended, kMended};
  options.compressor = [=](TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& compression) {
    CompressionMethodReport done;
    CompressionReport result = physicsAndMending(mesh, phi, compression, chosen, done);
    filled(done);
    return result;
  };
}

}  // namespace sinew
