#include "ExampleMesh.h"
#include "sinew/MeshIO/RegionMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sinew {
namespace {

TEST(RegionMesh, HoldsOneTissueWithItsArrays) {
  TissueMesh both = test::twoTissues();
  const std::size_t half = both.mesh.tets.size() / 2, nodes = both.mesh.nodes.size() / 2;
  for (std::size_t t = 0; t < both.mesh.tets.size(); ++t)
    both.arrays.cells[0].values[t] = static_cast<float>(t),
    both.arrays.cells[1].values[3 * t] = static_cast<float>(t);
  for (std::size_t n = 0; n < both.mesh.nodes.size(); ++n)
    both.arrays.points[0].values[n] = static_cast<float>(n);

  const TissueMesh second = regionMesh(both, 300);
  ASSERT_EQ(second.mesh.tets.size(), half);
  ASSERT_EQ(second.mesh.nodes.size(), nodes);
  EXPECT_EQ(second.mesh.tets, regionMesh(both, -7).mesh.tets) << "two blocks that are the same";
  EXPECT_EQ(second.mesh.nodes[3], both.mesh.nodes[nodes + 3]);
  EXPECT_EQ(second.mesh.kinds.size(), nodes);
  EXPECT_EQ(second.mesh.labels, std::vector<std::int32_t>(half, 300));
  ASSERT_EQ(second.regions.size(), 1u);
  EXPECT_EQ(second.regions[0].name, "Müskel");
  EXPECT_EQ(second.arrays.cells[0].values[5], static_cast<float>(half + 5));
  EXPECT_EQ(second.arrays.cells[1].components, 3);
  EXPECT_EQ(second.arrays.cells[1].values[3 * 5], static_cast<float>(half + 5));
  EXPECT_EQ(second.arrays.cells[1].values.size(), 3 * half);
  EXPECT_EQ(second.arrays.points[0].values[5], static_cast<float>(nodes + 5));
}

TEST(RegionMesh, NodesThatTissuesShareAreInBoth) {
  TissueMesh mesh{test::bccBlock({3, 3, 3}), {{1, "a"}, {2, "b"}}, {}};
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); t += 2) mesh.mesh.labels[t] = 2;
  const TissueMesh a = regionMesh(mesh, 1), b = regionMesh(mesh, 2);
  EXPECT_EQ(a.mesh.tets.size() + b.mesh.tets.size(), mesh.mesh.tets.size());
  EXPECT_GT(a.mesh.nodes.size() + b.mesh.nodes.size(), mesh.mesh.nodes.size());
}

}  // namespace
}  // namespace sinew
