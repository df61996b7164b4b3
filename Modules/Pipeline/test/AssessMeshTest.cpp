#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Pipeline/AssessMesh.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

Segmentation coarse(const std::string& phantom) {
  PhantomOptions options;
  options.spacing = Eigen::Vector3d(3, 2, 2);
  return makePhantom(phantom, options);
}

/// Meshes all tissues of a segmentation into a folder; the reports.
std::vector<TissueReport> meshInto(const test::TempFolder& folder, const Segmentation& segmentation) {
  MeshTissuesOptions options;
  options.edgeLength = 5;
  std::vector<int> all;
  for (std::size_t t = 0; t < segmentation.tissues.size(); ++t) all.push_back(static_cast<int>(t));
  return meshTissues(segmentation, all, folder.path(), options);
}

TEST(AssessMesh, AgreesWithTheReportOfTheRun) {
  const test::TempFolder folder;
  const Segmentation sphere = coarse("sphere");
  const TissueReport report = meshInto(folder, sphere).front();
  const MeshAssessment plain = assessMesh(folder / report.file);
  EXPECT_EQ(plain.quality.tets, report.quality.tets);
  EXPECT_EQ(plain.quality.maxAspectRatio, report.quality.maxAspectRatio);
  EXPECT_TRUE(plain.conditions.good());
  EXPECT_EQ(plain.topology.eulerCharacteristic, 2);
  EXPECT_FALSE(plain.fidelity.has_value());

  const MeshAssessment compared = assessMesh(folder / report.file, sphere, "");
  ASSERT_TRUE(compared.fidelity.has_value());
  EXPECT_EQ(compared.tissue, report.name);
  EXPECT_DOUBLE_EQ(compared.fidelity->volume, report.fidelity.volume);
  EXPECT_EQ(compared.fidelity->dice, report.fidelity.dice);
  EXPECT_EQ(compared.fidelity->labelVolume, report.fidelity.labelVolume);
}

TEST(AssessMesh, FindsTheTissueByFileNameThenByLabel) {
  const test::TempFolder folder;
  const Segmentation nested = coarse("nested");
  const auto reports = meshInto(folder, nested);
  ASSERT_GT(reports.size(), 1u);
  ASSERT_EQ(reports[1].status, TissueStatus::Meshed) << reports[1].message;
  const std::filesystem::path file = folder / reports[1].file;
  EXPECT_EQ(assessMesh(file, nested, "").tissue, reports[1].name);
  const std::filesystem::path renamed = folder / "other.vtu";
  std::filesystem::copy_file(file, renamed);
  EXPECT_EQ(assessMesh(renamed, nested, "").tissue, reports[1].name) << "by the labels of its tets";
  EXPECT_EQ(assessMesh(file, nested, reports[0].name).tissue, reports[0].name) << "a wish goes first";
}

TEST(AssessMesh, ATissueThatCannotBeToldIsRefused) {
  const test::TempFolder folder;
  const Segmentation nested = coarse("nested");
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {77};
  mesh.kinds.assign(4, NodeKind::Boundary);
  writeMesh({mesh, {}, {}}, folder / "x.vtu");
  const std::string message =
      test::messageOf<std::invalid_argument>([&] { assessMesh(folder / "x.vtu", nested, ""); });
  EXPECT_NE(message.find("x.vtu: 0 tissues"), std::string::npos) << message;
  EXPECT_THROW(assessMesh(folder / "missing.vtu"), std::runtime_error);
}

}  // namespace
}  // namespace sinew
