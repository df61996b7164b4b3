#include "ExpectSound.h"
#include "Seeds.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace sinew {
namespace {

constexpr unsigned kShapes = 120;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A way to mesh; lengths in mm, for shapes of about 10 mm and no thinner than 0.8 mm.
struct Meshing {
  const char* name;
  double edge, minEdge, curvature, tolerance;
  double maxVolumeError;  ///< flat triangles cut off what is round: an eighth of a rod of two cubes
};
constexpr std::array<Meshing, 5> kMeshings{{{"as by default", 2, 0, 1, 0, 0.13},
                                            {"fine", 1, 0, 1, 0, 0.13},
                                            {"fine where thin", 2, 0.4, 1, 0, 0.13},
                                            {"within a tolerance", 2.5, 0, 0, 0.05, 0.2},
                                            // The thinnest parts have one cube.
                                            {"one size", 0.8, 0, 0, 0, 0.3}}};

GenerateTetMeshOptions optionsOf(const Meshing& meshing) {
  GenerateTetMeshOptions options;
  options.edgeLength = meshing.edge;
  options.minEdgeLength = meshing.minEdge;
  options.curvature = meshing.curvature;
  options.tolerance = meshing.tolerance;
  return options;
}

/// The volume of phi < 0 by cells of size h, each filled in proportion to its distance.
double sampledVolume(const SignedDistance& phi, double h) {
  const Eigen::AlignedBox3d box = phi.bounds();
  const Eigen::Array3i n = (box.sizes() / h).array().ceil().cast<int>();
  double sum = 0;
  for (int z = 0; z < n.z(); ++z)
    for (int y = 0; y < n.y(); ++y)
      for (int x = 0; x < n.x(); ++x) {
        const Eigen::Vector3d centre = box.min() + h * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
        sum += std::clamp(0.5 - phi.value(centre) / h, 0.0, 1.0);
      }
  return sum * h * h * h;
}

double largestBoundaryPhi(const TetMesh& mesh, const SignedDistance& phi) {
  double largest = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.kinds[n] == NodeKind::Boundary) largest = std::max(largest, std::abs(phi.value(mesh.nodes[n])));
  return largest;
}

TEST(AnalyticShapes, EveryMeshIsSound) {
  const std::vector<unsigned> seeds = test::seeds(kShapes);
  EXPECT_FALSE(seeds.empty());
  for (const unsigned seed : seeds) {
    const Meshing& meshing = kMeshings[seed % kMeshings.size()];
    const int kind = static_cast<int>(seed % test::ShapeMaker::kKinds);
    // Two thirds of the shapes are known only in the band that the mesher asks for.
    const double band = seed % 3 == 0 ? kInfinite : 1.56 * meshing.edge;
    const test::RandomShape shape = test::ShapeMaker(seed).make(kind, {.resolution = 0.5, .band = band});
    SCOPED_TRACE(test::repeatWith(seed, shape.name() + ", " + meshing.name));
    TetMesh mesh;
    ASSERT_NO_THROW(mesh = generateTetMesh(shape, optionsOf(meshing)));
    const MeshQuality quality = meshQuality(mesh);
    const MeshBoundary boundary = meshBoundary(mesh);
    test::expectSound(quality, meshConditions(mesh, boundary),
                      largestBoundaryPhi(mesh, shape) / meshing.edge);
    EXPECT_NEAR(quality.volume / sampledVolume(shape, 0.25), 1, meshing.maxVolumeError);
    const bool followsShape = meshing.curvature > 0 || meshing.tolerance > 0;
    const std::optional<int> euler = test::ShapeMaker::eulerCharacteristic(kind);
    if (euler && followsShape) {
      const MeshTopology topology = meshTopology(mesh, boundary);
      EXPECT_EQ(topology.components, 1);
      EXPECT_EQ(topology.eulerCharacteristic, *euler);
    }
  }
}

}  // namespace
}  // namespace sinew
