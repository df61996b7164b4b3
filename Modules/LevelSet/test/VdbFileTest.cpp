#include "SolidShapes.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetGrid.h"
#include "sinew/LevelSet/VdbFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using openvdb::FloatGrid;

LevelSet shape() {
  return levelSetFromField(test::sampled(torus({1, 2, 3}, {1, 1, 4}, 7, 3), 2, test::tiltedLattice(0.5)));
}

void writeGrid(const openvdb::GridBase::Ptr& grid, const std::filesystem::path& file) {
  openvdb::io::File(file.string()).write(openvdb::GridCPtrVec{grid});
}

TEST(VdbFile, WhatWasWrittenIsReadBack) {
  const test::TempFolder folder;
  const LevelSet written = shape();
  writeVdb(written, "biceps", folder / "a.vdb");
  const LevelSet read = readVdb(folder / "a.vdb");
  EXPECT_TRUE(read.frame.isApprox(written.frame, 1e-12));
  EXPECT_NEAR(read.voxelSize, written.voxelSize, 1e-12);
  EXPECT_EQ(read.band, written.band);
  const FloatGrid &a = *written.grid->grid, &b = *read.grid->grid;
  EXPECT_EQ(b.getName(), "biceps");
  EXPECT_NE(a.getName(), "biceps");  // the level set itself stays as it is
  EXPECT_EQ(a.activeVoxelCount(), b.activeVoxelCount());
  EXPECT_TRUE(a.tree().hasSameTopology(b.tree()));
  const DenseLevelSet denseRead = fieldFromLevelSet(read), dense = fieldFromLevelSet(written);
  const auto first = firstSampleOn({dense.frame, dense.voxelSize}, denseRead);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(onBox(dense, *first, *first + denseRead.phi.size - Eigen::Vector3i::Ones()).phi.values,
            denseRead.phi.values);
  test::forEachSample(denseRead, [&, band = static_cast<float>(read.band)](const Vector3d&, float phi) {
    ASSERT_LE(std::abs(phi), band);
  });
}

TEST(VdbFile, TheFirstLevelSetCounts) {
  const test::TempFolder folder;
  const auto fog = FloatGrid::create(0);
  fog->setName("fog");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  const auto mask = openvdb::BoolGrid::create();
  mask->setName("mask");
  const auto levelSet = shape().grid->grid->deepCopy();
  levelSet->setName("surface");
  openvdb::io::File((folder / "many.vdb").string()).write(openvdb::GridCPtrVec{mask, fog, levelSet});
  EXPECT_EQ(readVdb(folder / "many.vdb").grid->grid->getName(), "surface");
}

TEST(VdbFile, RefusesWhatIsNoLevelSetOnEvenSamples) {
  openvdb::initialize();
  const test::TempFolder folder;
  const auto file = folder / "bad.vdb";
  const auto changed = [](const std::function<void(FloatGrid&)>& change) {
    const auto grid = shape().grid->grid->deepCopy();
    change(*grid);
    return grid;
  };
  const auto placed = [&](const openvdb::Mat4d& rows) {
    return changed(
        [&](FloatGrid& grid) { grid.setTransform(openvdb::math::Transform::createLinearTransform(rows)); });
  };
  openvdb::Mat4d sheared = openvdb::Mat4d::identity(), stretched = sheared, mirrored = sheared;
  sheared[1][0] = 0.2;
  stretched[2][2] = 1.1;
  mirrored[0][0] = -1;
  const std::string uneven = "the samples of its level set are stretched, sheared or mirrored";
  const std::string damaged = "damaged: its level set holds values that are no distances";
  const std::vector<std::pair<openvdb::GridBase::Ptr, std::string>> cases{
      {changed([](FloatGrid& g) { g.setGridClass(openvdb::GRID_FOG_VOLUME); }),
       "has no level set: a float grid of class \"level set\""},
      {openvdb::BoolGrid::create(), "has no level set: a float grid of class \"level set\""},
      {changed([](FloatGrid& g) { g.clear(); }), "its level set has no surface"},
      {placed(sheared), uneven},
      {placed(stretched), uneven},
      {placed(mirrored), uneven},
      {changed([](FloatGrid& g) {
         g.tree().setValue({1, 2, 3}, std::nanf(""));
       }),
       damaged},
      {changed([](FloatGrid& g) { g.tree().root().setBackground(-1, false); }), damaged},
      {changed([](FloatGrid& g) {
         g.tree().setValue({1 << 28, 0, 0}, 1);
       }),
       "the box of its level set has more than 2^31 samples"}};
  for (const auto& [grid, what] : cases) {
    writeGrid(grid, file);
    EXPECT_EQ(test::messageOf<std::runtime_error>([&] { readVdb(file); }), file.string() + ": " + what);
  }
}

TEST(VdbFile, DamagedFilesEndInOneLine) {
  const test::TempFolder folder;
  writeVdb(shape(), "a", folder / "a.vdb");
  const std::string whole = test::readBytes(folder / "a.vdb");
  const auto refused = [&](const std::string& bytes) {
    const auto file = folder / "b.vdb";
    test::writeBytes(file, bytes);
    const std::string message = test::messageOf<std::runtime_error>([&] { readVdb(file); });
    EXPECT_EQ(message.find(file.string() + ": "), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  refused("");
  refused("some words that are no grid\n");
  for (std::size_t part = 0; part < 64; ++part) refused(whole.substr(0, part * whole.size() / 64));
  refused(whole.substr(0, whole.size() - 1));
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { readVdb(folder / "none.vdb"); }),
            (folder / "none.vdb").string() + ": no such file");
  EXPECT_THROW(readVdb(folder.path()), std::runtime_error);
}

TEST(VdbFile, AFileThatCannotBeWrittenIsNamed) {
  const test::TempFolder folder;
  const auto file = folder / "no folder" / "a.vdb";
  const std::string message = test::messageOf<std::runtime_error>([&] { writeVdb(shape(), "a", file); });
  EXPECT_EQ(message.find(file.string() + ": cannot be written"), 0u) << message;
}

}  // namespace
}  // namespace sinew
