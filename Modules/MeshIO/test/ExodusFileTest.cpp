#include "ExodusFile.h"
#include "SolverMeshes.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkCellData.h>
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
    const auto file =
        folder_ / (options.quadratic ? "quadratic.exo" : "straight.exo");  // the reader looks at names
    writeMesh(mesh, file, options);
    reader_->SetFileName(file.c_str());
    reader_->UpdateInformation();
    for (int s = 0; s < reader_->GetNumberOfSideSetArrays(); ++s)
      reader_->SetSideSetArrayStatus(reader_->GetSideSetArrayName(s), 1);
    reader_->GenerateGlobalElementIdArrayOn();
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

TEST_F(ExodusFile, ElementsHaveTheirNumbersOfTheMesh) {
  const TissueMesh mesh = test::twoHalves();
  for (const Block& block : write(mesh)) {
    vtkDataArray* numbers = block.grid->GetCellData()->GetArray("GlobalElementId");
    ASSERT_NE(numbers, nullptr);
    for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
      EXPECT_EQ(mesh.mesh.labels[static_cast<std::size_t>(numbers->GetComponent(i, 0)) - 1], block.id);
  }
}

TEST_F(ExodusFile, SideSetsCloseTheTissues) {
  const TissueMesh mesh = test::twoHalves();
  for (const bool quadratic : {false, true}) {
    write(mesh, {.quadratic = quadratic});
    ASSERT_EQ(reader_->GetNumberOfSideSetArrays(), 2);
    constexpr unsigned kSideSets = 4;  // among the reader's kinds of blocks and sets
    auto* sets = vtkMultiBlockDataSet::SafeDownCast(reader_->GetOutput()->GetBlock(kSideSets));
    ASSERT_NE(sets, nullptr);
    for (unsigned s = 0; s < 2; ++s) {
      EXPECT_NE(std::string(reader_->GetSideSetArrayName(static_cast<int>(s))).find(" half_boundary"),
                std::string::npos);
      auto* sides = vtkUnstructuredGrid::SafeDownCast(sets->GetBlock(s));
      const int label = reader_->GetObjectId(vtkExodusIIReader::SIDE_SET, static_cast<int>(s));
      Eigen::Vector3d area = Eigen::Vector3d::Zero();
      double volume = 0;
      for (vtkIdType i = 0; i < sides->GetNumberOfCells(); ++i) {
        vtkIdType size = 0;
        const vtkIdType* nodes = nullptr;
        sides->GetCellPoints(i, size, nodes);
        ASSERT_EQ(size, quadratic ? 6 : 3);
        const Eigen::Vector3d origin = mesh.mesh.nodes[0];
        const Eigen::Vector3d a = Eigen::Vector3d(sides->GetPoint(nodes[0])) - origin,
                              b = Eigen::Vector3d(sides->GetPoint(nodes[1])) - origin,
                              c = Eigen::Vector3d(sides->GetPoint(nodes[2])) - origin;
        area += (b - a).cross(c - a) / 2;
        volume += a.dot(b.cross(c)) / 6;
      }
      double tets = 0;
      for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
        const auto& [a, b, c, d] = mesh.mesh.tets[t];
        const auto& x = mesh.mesh.nodes;
        if (mesh.mesh.labels[t] == label) tets += (x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]) / 6;
      }
      EXPECT_LT(area.norm(), 1e-3);     // closed, of floats up to 700
      EXPECT_NEAR(volume, tets, 1e-3);  // and outward
    }
  }
}

TEST_F(ExodusFile, TissuesShareTheirNodes) {
  const TissueMesh mesh = test::twoHalves();
  write(mesh);
  EXPECT_EQ(reader_->GetTotalNumberOfNodes(), std::ssize(mesh.mesh.nodes));
  EXPECT_EQ(reader_->GetTotalNumberOfElements(), std::ssize(mesh.mesh.tets));
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

TEST_F(ExodusFile, TheTitleSaysTheUnit) {
  WriteMeshOptions options;
  options.perMm = 0.1;
  write(test::namedTets({"a"}), options);
  EXPECT_STREQ(reader_->GetTitle(), "Sinew mesh, unit cm, space LPS");
}

TEST_F(ExodusFile, HardNamesStayDistinctAndWhole) {
  const auto names = test::hardNames();
  std::vector<std::string> found;
  for (const Block& block : write(test::namedTets(names))) found.push_back(block.name);
  ASSERT_EQ(found.size(), names.size());
  EXPECT_EQ(std::set(found.begin(), found.end()).size(), names.size());
  EXPECT_EQ(found[0].substr(0, names[0].size()), names[0]);
  EXPECT_EQ(found[1].substr(0, names[1].size()), names[1]);
  EXPECT_EQ(found[2].substr(0, names[2].size()), names[2]);
}

TEST_F(ExodusFile, AMeshWithoutTetsIsRefused) {
  EXPECT_NE(test::messageOf<std::runtime_error>([&] { write({}); }).find("without tets"), std::string::npos);
}

}  // namespace
}  // namespace sinew
