#include "ExodusFile.h"
#include "SolverMeshes.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkExodusIIReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <set>

namespace sinew {
namespace {

struct Block {
  std::string name;
  int id;
  vtkUnstructuredGrid* grid;
};

class ExodusFile : public ::testing::Test {
 protected:
  std::vector<Block> write(const TissueMesh& mesh, const WriteMeshOptions& options = {}) {
    writeMesh(mesh, folder_ / "a.exo", options);
    reader_->SetFileName((folder_ / "a.exo").c_str());
    reader_->Update();
    auto* all = vtkMultiBlockDataSet::SafeDownCast(reader_->GetOutput()->GetBlock(0));
    std::vector<Block> blocks;
    for (int b = 0; b < reader_->GetNumberOfElementBlockArrays(); ++b)
      blocks.push_back({reader_->GetElementBlockArrayName(b),
                        reader_->GetObjectId(vtkExodusIIReader::ELEM_BLOCK, b),
                        vtkUnstructuredGrid::SafeDownCast(all->GetBlock(static_cast<unsigned>(b)))});
    return blocks;
  }
  test::TempFolder folder_;
  vtkNew<vtkExodusIIReader> reader_;
};

TEST_F(ExodusFile, HasABlockForEveryTissue) {
  const TissueMesh mesh = test::twoHalves();
  const std::vector<Block> blocks = write(mesh);
  ASSERT_EQ(blocks.size(), 2u);
  for (const Block& block : blocks) {
    const auto region = std::ranges::find(mesh.regions, block.id, &TissueRegion::label);
    ASSERT_NE(region, mesh.regions.end());
    EXPECT_TRUE(block.name.starts_with(region->name)) << block.name;
    std::vector<std::size_t> tets;
    for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t)
      if (mesh.mesh.labels[t] == block.id) tets.push_back(t);
    ASSERT_EQ(block.grid->GetNumberOfCells(), std::ssize(tets));
    for (std::size_t i = 0; i < tets.size(); ++i) {
      vtkIdType size = 0;
      const vtkIdType* nodes = nullptr;
      block.grid->GetCellPoints(static_cast<vtkIdType>(i), size, nodes);
      ASSERT_EQ(size, 4);  // the reader turns the coordinates, up to 700, into floats
      for (int k = 0; k < 4; ++k)
        EXPECT_LT(
            (Eigen::Vector3d(block.grid->GetPoint(nodes[k])) - mesh.mesh.nodes[mesh.mesh.tets[tets[i]][k]])
                .norm(),
            1e-4);
    }
  }
}

TEST_F(ExodusFile, HoldsTetsOfTenNodes) {
  WriteMeshOptions options;
  options.quadratic = true;
  const std::vector<Block> blocks = write(test::namedTets({"a"}), options);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].grid->GetCellType(0), VTK_QUADRATIC_TETRA);
  vtkIdType size = 0;
  const vtkIdType* nodes = nullptr;
  blocks[0].grid->GetCellPoints(0, size, nodes);
  ASSERT_EQ(size, 10);
  for (int e = 0; e < 6; ++e) {
    const auto x = [&](int n) { return Eigen::Vector3d(blocks[0].grid->GetPoint(nodes[n])); };
    EXPECT_LT((x(4 + e) - (x(kMiddles[e][0]) + x(kMiddles[e][1])) / 2).norm(), 1e-12);
  }
}

TEST_F(ExodusFile, TheTitleSaysTheUnitAndNoDate) {
  WriteMeshOptions options;
  options.perMm = 0.1;
  write(test::namedTets({"a"}), options);
  EXPECT_EQ(std::string(reader_->GetTitle()).substr(0, 30), "Sinew mesh, unit cm, space LPS");
  const std::string bytes = test::readBytes(folder_ / "a.exo");
  EXPECT_EQ(bytes.find("vtkExodusIIWriter"), std::string::npos);
}

TEST_F(ExodusFile, HardNamesStayDistinct) {
  const auto names = test::hardNames();
  std::set<std::string> found;
  for (const Block& block : write(test::namedTets(names))) found.insert(block.name);
  EXPECT_EQ(found.size(), names.size());
}

}  // namespace
}  // namespace sinew
