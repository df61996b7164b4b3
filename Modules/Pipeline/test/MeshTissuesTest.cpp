#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr double kBallRadius = 9.5, kSmallRadius = 6.5;

/// Two balls, and a row of ten voxels away from both; voxels of 1 mm, on a grid that is turned and mirrored
/// in LPS.
Segmentation ballsAndThread() {
  Segmentation segmentation;
  segmentation.source = "balls.nrrd";
  segmentation.geometry.size = {48, 26, 26};
  segmentation.geometry.origin = {10, 20, -30};
  segmentation.geometry.direction =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  segmentation.geometry.direction.col(2) *= -1;
  segmentation.layers.emplace_back();
  for (int z = 0; z < 26; ++z)
    for (int y = 0; y < 26; ++y)
      for (int x = 0; x < 48; ++x) {
        const Eigen::Vector3d centre(x, y, z);
        const bool ball = (centre - Eigen::Vector3d(13, 12.5, 12.5)).norm() < kBallRadius;
        const bool small = (centre - Eigen::Vector3d(36, 12.5, 12.5)).norm() < kSmallRadius;
        segmentation.layers[0].push_back(ball                                    ? 5
                                         : small                                 ? 7
                                         : x > 20 && x <= 30 && y == 2 && z == 2 ? 9
                                                                                 : 0);
      }
  for (const auto& [label, name] : {std::pair{5, "ball"}, {7, "small ball"}, {9, "thread"}}) {
    Tissue tissue;
    tissue.label = label;
    tissue.name = name;
    segmentation.tissues.push_back(tissue);
  }
  updateTissueTable(segmentation);
  return segmentation;
}

MeshTissuesOptions coarse() {
  MeshTissuesOptions options;
  options.edgeLength = 3;
  options.curvature = 0;  // nothing makes the lattice finer for the thread
  return options;
}

double ballVolume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

TEST(MeshTissues, WritesOneSoundMeshPerTissueAndNamesWhatIsLost) {
  const test::TempFolder folder;
  const Segmentation segmentation = ballsAndThread();
  const std::vector<TissueReport> reports = meshTissues(segmentation, {0, 1, 2}, folder.path(), coarse());
  ASSERT_EQ(reports.size(), 3u);
  EXPECT_EQ(test::entriesOf(folder.path()), 2u);

  const double radii[]{kBallRadius, kSmallRadius};
  for (int t = 0; t < 2; ++t) {
    const TissueReport& report = reports[t];
    EXPECT_EQ(report.status, TissueStatus::Meshed) << report.message;
    EXPECT_EQ(report.message, "");
    EXPECT_EQ(report.file, t == 0 ? "ball.vtu" : "small_ball.vtu");
    EXPECT_TRUE(report.conditions.good());
    EXPECT_EQ(report.topology.components, 1);
    EXPECT_EQ(report.topology.eulerCharacteristic, 2);
    EXPECT_EQ(report.levelSetComponents, 1);
    EXPECT_EQ(report.levelSetEuler, 2);
    EXPECT_EQ(report.lost.components, 0);
    // Triangles of edge a inscribed in a ball of radius r cut off 3/8 (a/r)^2 of its volume, 4 and 8 %: the
    // boundary is moved outwards by a third of that times r, a twentieth of an edge at most.
    const double offset = std::pow(3 / radii[t], 2) / 8 * radii[t];
    EXPECT_NEAR(report.fidelity.surfaceOffset, std::min(offset, 0.05 * 3), 0.5 * offset);
    EXPECT_NEAR(report.fidelity.volume / report.fidelity.levelSetVolume, 1, t == 0 ? 0.005 : 0.06);
    EXPECT_NEAR(report.fidelity.levelSetVolume / ballVolume(radii[t]), 1, 0.02) << "voxels";
    EXPECT_GT(report.fidelity.dice, 0.93);
    EXPECT_LT(report.fidelity.maxBoundaryPhi, 1e-3 * report.edgeLength);
    EXPECT_GT(report.seconds.size(), 3u);

    const TetMesh mesh = readMesh(folder / report.file).mesh;
    EXPECT_EQ(static_cast<std::int64_t>(mesh.tets.size()), report.quality.tets);
    EXPECT_EQ(mesh.labels.front(), report.label);
    const Eigen::Vector3d centre =
        segmentation.geometry.indexToPhysical() * Eigen::Vector3d(t == 0 ? 13 : 36, 12.5, 12.5);
    for (const Eigen::Vector3d& node : mesh.nodes)
      ASSERT_LT((node - centre).norm(), radii[t] + 0.5) << "half a voxel around the ball";
  }

  const TissueReport& thread = reports[2];
  EXPECT_EQ(thread.status, TissueStatus::Lost);
  EXPECT_EQ(thread.file, "");
  EXPECT_EQ(thread.lost.components, 1);
  EXPECT_DOUBLE_EQ(thread.lost.volume, 10);
  EXPECT_NE(thread.message.find("too small for the lattice: 10 voxels"), std::string::npos) << thread.message;
}

TEST(MeshTissues, TheVolumeIsKeptAtAnyEdgeLength) {
  // The small ball misses so much that the offset is at its limit: the band of the level set must hold it.
  const Segmentation segmentation = ballsAndThread();
  int atTheLimit = 0;
  for (double edge = 5; edge < 8; edge += 0.017) {
    const test::TempFolder folder;
    MeshTissuesOptions options = coarse();
    options.edgeLength = edge;
    const TissueReport report = meshTissues(segmentation, {1}, folder.path(), options).front();
    EXPECT_EQ(report.status, TissueStatus::Meshed) << "edge length " << edge << ": " << report.message;
    atTheLimit += report.fidelity.surfaceOffset == 0.05 * edge;
  }
  EXPECT_GT(atTheLimit, 10) << "these sizes are no test";
}

TEST(MeshTissues, ASpeckIsMeshedAtTheDefaultSize) {
  const test::TempFolder folder;
  const std::vector<TissueReport> reports = meshTissues(ballsAndThread(), {0, 2}, folder.path(), {});
  EXPECT_EQ(reports[0].edgeLength, 2);
  const TissueReport& thread = reports[1];
  ASSERT_EQ(thread.status, TissueStatus::Meshed) << thread.message;
  EXPECT_NEAR(thread.edgeLength, std::cbrt(10) / 3, 1e-9);
  EXPECT_NE(thread.message.find("edge length reduced to 0.718 mm"), std::string::npos) << thread.message;
  EXPECT_EQ(thread.topology.components, 1);
  EXPECT_NEAR(thread.fidelity.volume, 10, 1);
}

TEST(MeshTissues, ThinPartsAreWhole) {
  const test::TempFolder folder;
  const Segmentation thin = makePhantom("thin");
  std::vector<int> all(thin.tissues.size());
  std::iota(all.begin(), all.end(), 0);
  int halfVoxels = 0;
  for (const TissueReport& report : meshTissues(thin, all, folder.path(), {})) {
    SCOPED_TRACE(report.name);
    ASSERT_EQ(report.status, TissueStatus::Meshed);
    EXPECT_NEAR(report.fidelity.volume / report.fidelity.levelSetVolume, 1, 0.005);
    EXPECT_EQ(report.topology.components, 1);
    EXPECT_EQ(report.topology.eulerCharacteristic, report.levelSetEuler);
    halfVoxels += report.minEdgeLength < 0.6 * thin.geometry.meanSpacing();
  }
  EXPECT_GT(halfVoxels, 0) << "of the plate or the tube of one voxel";
  EXPECT_LT(halfVoxels, 4) << "those of two voxels and more do without";
}

TEST(MeshTissues, TheFilesDoNotDependOnTheNumberOfThreads) {
  const Segmentation segmentation = ballsAndThread();
  std::vector<std::string> first;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const test::TempFolder folder;
    meshTissues(segmentation, {0, 1}, folder.path(), coarse());
    const std::vector<std::string> files{test::readBytes(folder / "ball.vtu"),
                                         test::readBytes(folder / "small_ball.vtu")};
    if (first.empty()) first = files;
    EXPECT_TRUE(files == first) << threads << " threads";
  }
}

TEST(MeshTissues, ATissueMayHaveItsOwnSize) {
  const test::TempFolder folder;
  MeshTissuesOptions options = coarse();
  options.sizes["small ball"] = 2;
  const auto reports = meshTissues(ballsAndThread(), {0, 1}, folder.path(), options);
  EXPECT_EQ(reports[0].edgeLength, 3);
  EXPECT_EQ(reports[1].edgeLength, 2);
}

/// The reports of some tissues, whose files nobody keeps.
std::vector<TissueReport> reportsOf(const std::vector<int>& tissues, const MeshTissuesOptions& options) {
  const test::TempFolder folder;
  return meshTissues(ballsAndThread(), tissues, folder.path(), options);
}

TEST(MeshTissues, TheWantedNumberOfTetsIsMetForEveryTissue) {
  MeshTissuesOptions options;
  options.targetTets = 20'000;
  for (const TissueReport& report : reportsOf({0, 1}, options)) {
    EXPECT_NEAR(static_cast<double>(report.quality.tets), 20'000, 2000) << report.name;
    EXPECT_EQ(report.message, "") << report.name;
  }
}

TEST(MeshTissues, TheEdgeLengthFoundGivesTheSameMeshAgain) {
  const test::TempFolder searched, again;
  MeshTissuesOptions options;
  options.targetTets = 5000;
  const TissueReport found = meshTissues(ballsAndThread(), {0}, searched.path(), options).front();
  options.sizes["ball"] = found.edgeLength;
  options.minEdgeLength = found.minEdgeLength;
  const TissueReport report = meshTissues(ballsAndThread(), {0}, again.path(), options).front();
  EXPECT_EQ(report.edgeLength, found.edgeLength) << "a size of its own goes first";
  EXPECT_EQ(test::readBytes(searched / "ball.vtu"), test::readBytes(again / "ball.vtu"));
}

TEST(MeshTissues, ANumberOfTetsThatCannotBeMetIsTold) {
  MeshTissuesOptions options;
  options.targetTets = 20;  // a ball cut from cubes of its own extent has more
  const TissueReport report = reportsOf({0}, options).front();
  EXPECT_EQ(report.status, TissueStatus::Meshed);
  EXPECT_NE(report.message.find(" are as near as the search came to 20"), std::string::npos)
      << report.message;
}

TEST(MeshTissues, TheVolumeIsPreservedWithinATenthOfAPercent) {
  MeshTissuesOptions options;
  options.preserveVolume = true;
  for (const double edge : {2., 3.}) {
    options.edgeLength = edge;
    const TissueReport report = reportsOf({0}, options).front();
    EXPECT_NEAR(report.fidelity.volume / report.fidelity.levelSetVolume, 1, 0.001) << edge;
    EXPECT_GT(report.fidelity.surfaceOffset, 0) << "chords lie inside";
    EXPECT_LT(report.fidelity.surfaceOffset, 0.1 * edge);
    EXPECT_LT(report.fidelity.maxBoundaryPhi, 1e-3 * edge) << "of the surface that was moved";
  }
}

TEST(MeshTissues, AVolumeOutOfReachIsTold) {
  MeshTissuesOptions options = coarse();
  options.edgeLength = 1.5 * kBallRadius;  // chords cut off more than a tenth of an edge gives back
  options.preserveVolume = true;
  const TissueReport report = reportsOf({0}, options).front();
  EXPECT_DOUBLE_EQ(report.fidelity.surfaceOffset, 0.1 * 1.5 * kBallRadius);
  EXPECT_NE(report.message.find("the volume could only be brought within "), std::string::npos)
      << report.message;
}

TEST(MeshTissues, AnUnderResolvedTissueIsToldASizeThatHelps) {
  MeshTissuesOptions options = coarse();
  options.edgeLength = kBallRadius;
  const TissueReport report = reportsOf({0}, options).front();
  ASSERT_TRUE(report.message.starts_with("under-resolved: volume ")) << report.message;
  ASSERT_TRUE(report.message.ends_with("; try --size 'ball=4.7mm'")) << report.message;
  options.sizes["ball"] = 4.7;
  EXPECT_EQ(reportsOf({0}, options).front().message, "");
  const std::string lost = reportsOf({2}, options).front().message;
  ASSERT_TRUE(lost.ends_with("; try --size 'thread=0.71mm'")) << lost;
  options.sizes["thread"] = 0.71;
  EXPECT_EQ(reportsOf({2}, options).front().status, TissueStatus::Meshed);
}

TEST(MeshTissues, APlaceWhereTheTopologyDiffersIsTold) {
  Segmentation segmentation = ballsAndThread();
  const Eigen::Vector3d place = segmentation.geometry.indexToPhysical() * Eigen::Vector3d(26, 15, 10);
  for (std::int32_t& label : segmentation.layers[0]) label = label == 7 ? 5 : label;
  for (int x = 20; x < 32; ++x)
    segmentation.layers[0][x + 48 * (15 + 26 * 10)] = 5;  // a bridge of single voxels
  updateTissueTable(segmentation);
  const test::TempFolder folder;
  MeshTissuesOptions options = coarse();
  options.smoothing.kind = Smoothing::Kind::None;  // a Gauss would wear the bridge away
  const TissueReport report = meshTissues(segmentation, {0}, folder.path(), options).front();
  ASSERT_EQ(report.topologyDifferences.size(), 1u);
  EXPECT_EQ(report.topologyDifferenceCount, 1);
  const TopologyDifference& bridge = report.topologyDifferences[0];
  EXPECT_EQ(bridge.change, TopologyChange::BridgeLost);
  EXPECT_LT((bridge.place - place).norm(), 6) << "the bridge is 12 voxels long";
  EXPECT_GT(bridge.width, 0.5);
  EXPECT_LT(bridge.width, 1.5);
  EXPECT_EQ(bridge.euler, -2);
  EXPECT_EQ(report.topology.components, 2);
  EXPECT_EQ(report.levelSetComponents, 1);
  EXPECT_NE(report.message.find("2 components instead of 1"), std::string::npos) << report.message;
  EXPECT_NE(report.message.find("a bridge lost"), std::string::npos) << report.message;
}

TEST(MeshTissues, QualityGoesIntoTheFileOnRequest) {
  const test::TempFolder folder;
  MeshTissuesOptions options = coarse();
  meshTissues(ballsAndThread(), {0}, folder.path(), options);
  const std::string plain = test::readBytes(folder / "ball.vtu");
  EXPECT_EQ(plain.find("aspect_ratio"), std::string::npos);
  options.withQuality = true;
  meshTissues(ballsAndThread(), {0}, folder.path(), options);
  const std::string full = test::readBytes(folder / "ball.vtu");
  for (const char* name : {"aspect_ratio", "min_dihedral_deg", "max_dihedral_deg", "phi"})
    EXPECT_NE(full.find("type=\"Float32\" Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

TEST(MeshTissues, TheWorstTetsAreInTheMeshThatWasWritten) {
  const test::TempFolder folder;
  const TissueReport report = meshTissues(ballsAndThread(), {0}, folder.path(), coarse()).front();
  const TetMesh mesh = readMesh(folder / "ball.vtu").mesh;
  ASSERT_EQ(report.worst.size(), 3 * kRankedTets);
  EXPECT_EQ(report.worst[0].value, report.quality.maxAspectRatio);
  for (const WorstElement& worst : report.worst) {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const std::int32_t node : mesh.tets[worst.element]) centroid += mesh.nodes[node] / 4;
    EXPECT_LT((centroid - worst.place).norm(), 1e-12 * worst.place.norm());
  }
}

TEST(MeshTissues, OneFailureLeavesTheOthersAlone) {
  const test::TempFolder folder;
  fs::create_directory(folder / "ball.vtu");  // stands in the way of the file
  test::writeBytes(folder / "ball.vtu" / "occupied", "");
  const auto reports = meshTissues(ballsAndThread(), {0, 1}, folder.path(), coarse());
  EXPECT_EQ(reports[0].status, TissueStatus::Failed);
  EXPECT_NE(reports[0].message.find("ball.vtu"), std::string::npos) << reports[0].message;
  EXPECT_EQ(reports[1].status, TissueStatus::Meshed);
  EXPECT_EQ(test::entriesOf(folder.path()), 2u) << "a partial file is left";
}

TEST(MeshTissues, AnOldFileGoesWithItsTissue) {
  const test::TempFolder folder;
  test::writeBytes(folder / "thread.vtu", "from an earlier run");
  meshTissues(ballsAndThread(), {2}, folder.path(), coarse());
  EXPECT_EQ(test::entriesOf(folder.path()), 0u);
}

TEST(MeshTissues, ACallbackStopsTheRun) {
  struct Enough {};
  const test::TempFolder folder;
  for (const std::string stopAt : {"level set", "lattice", "measuring", "writing"}) {
    const TissueProgress stop = [&](const std::string&, const std::string& stage, double) {
      if (stage == stopAt) throw Enough{};
    };
    EXPECT_THROW(meshTissues(ballsAndThread(), {0, 1}, folder.path(), coarse(), stop), Enough) << stopAt;
    EXPECT_EQ(test::entriesOf(folder.path()), 0u) << stopAt;
  }
}

TEST(MeshTissues, ProgressRisesToOne) {
  const test::TempFolder folder;
  double last = 0;
  const TissueProgress note = [&](const std::string&, const std::string&, double done) {
    EXPECT_GE(done, last);
    last = done;
  };
  meshTissues(ballsAndThread(), {0, 1, 2}, folder.path(), coarse(), note);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(MeshTissues, BadSizesAreRefusedBeforeAnyComputing) {
  const test::TempFolder folder;
  const auto messageFor = [&](const MeshTissuesOptions& options) {
    return test::messageOf<std::invalid_argument>([&] {
      meshTissues(ballsAndThread(), {0, 1, 2}, folder.path(), options,
                  [](const auto&, const auto&, double) { FAIL() << "computing has begun"; });
    });
  };
  MeshTissuesOptions options;
  options.edgeLength = 0;
  EXPECT_EQ(messageFor(options), "the edge length is 0mm, but must be larger than 0");
  options.edgeLength = Length::voxels(-1);
  EXPECT_EQ(messageFor(options), "the edge length is -1vox, but must be larger than 0");
  options = {};
  options.sizes["bal"] = 1;
  EXPECT_NE(messageFor(options).find("no tissue 'bal'; the nearest names are 'ball'"), std::string::npos);
  options = {};
  options.maxEdgeLength = -1;
  EXPECT_NE(messageFor(options).find("largest edge length is -1mm"), std::string::npos);
  options = {};
  options.minEdgeLength = Length::voxels(-1);
  EXPECT_NE(messageFor(options).find("smallest edge length is -1vox"), std::string::npos);
  options = {};
  options.tolerance = -0.5;
  EXPECT_NE(messageFor(options).find("tolerance is -0.5mm"), std::string::npos);
  options = {};
  options.targetTets = -1;
  EXPECT_NE(messageFor(options).find("number of tets is -1"), std::string::npos);
  options = {};
  options.edgeLength = 1e-4;
  const std::string tooSmall = messageFor(options);
  EXPECT_NE(tooSmall.find("balls.nrrd: 'ball' at edge length 1e-04mm would take about "), std::string::npos)
      << tooSmall;
  EXPECT_NE(tooSmall.find("mm or more"), std::string::npos) << tooSmall;
}

}  // namespace
}  // namespace sinew
