#include "ScriptRunner.h"
#include "sinew/Repair/RepairSegmentation.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numbers>
#include <sstream>

namespace sinew {
namespace {

using std::numbers::pi;
using test::smallArm;
using Lines = std::vector<std::string>;

/// The numbers that a script prints.
std::vector<double> numbers(const std::string& script, RepairOptions options = {}) {
  std::vector<double> numbers;
  for (const std::string& line : test::printed(script, std::move(options))) {
    std::istringstream words(line);
    for (double number; words >> number;) numbers.push_back(number);
  }
  return numbers;
}

RepairResult repaired(const std::string& script, const RepairOptions& options = {}) {
  return repairSegmentation(smallArm(), script, options);
}

std::int64_t voxelsOf(const Segmentation& segmentation, const std::string& name) {
  const auto found = std::ranges::find(segmentation.tissues, name, &Tissue::name);
  return found == segmentation.tissues.end() ? 0 : found->voxels;
}

/// Voxels of one value in the first layer, and those that differ.
std::int64_t changedVoxels(const Segmentation& a, const Segmentation& b) {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < a.layers[0].size(); ++n) count += a.layers[0][n] != b.layers[0][n];
  return count;
}

struct Primitive {
  std::string script;
  double volume;  ///< mm^3
};

class Primitives : public testing::TestWithParam<Primitive> {};

TEST_P(Primitives, HaveTheirVolume) {
  const std::vector<double> volumes =
      numbers("print(volume(" + GetParam().script + "))", {.gridSpacing = 0.5});
  ASSERT_EQ(volumes.size(), 1u);
  // Samples of 0.5 mm cut edges and corners off.
  EXPECT_NEAR(volumes[0] / GetParam().volume, 1, 0.015) << GetParam().script;
}

INSTANTIATE_TEST_SUITE_P(
    All, Primitives,
    testing::Values(
        Primitive{"sphere{center={10, 10, 10}, radius=8}", 4 * pi / 3 * 512},
        Primitive{"sphere{center={10, 10, 10}, radius='8vox'}", 4 * pi / 3 * 512},
        Primitive{"ellipsoid{center={10, 10, 10}, radii={6, 8, 10}}", 4 * pi / 3 * 480},
        Primitive{"box{min={0, 0, 0}, max={10, 12, 14}}", 1680},
        Primitive{"cylinder{from={0, 0, 0}, to={0, 0, 20}, radius=8}", pi * 64 * 20},
        Primitive{"capsule{from={0, 0, 0}, to={20, 0, 0}, radius=6}", pi * 36 * 20 + 4 * pi / 3 * 216},
        Primitive{"cone{from={0, 0, 0}, to={0, 20, 0}, radius=10, end_radius=5}", pi * 20 / 3 * 175},
        Primitive{"torus{center={0, 0, 0}, axis={0, 0, 1}, radius=12, tube=5}", 2 * pi* pi * 12 * 25},
        Primitive{"tube{points={{0, 0, 0}, {20, 0, 0}}, radius=6}", pi * 36 * 20 + 4 * pi / 3 * 216},
        Primitive{"hull{points={{0,0,0}, {20,0,0}, {0,20,0}, {0,0,20}}}", 8000. / 6},
        Primitive{"halfspace{point={0,0,5}, normal={0,0,1}} * box{min={0,0,0}, max={10,10,10}}", 500},
        Primitive{"box{min={0,0,0}, max={10,10,10}} - halfspace{point={0,0,5}, normal={0,0,1}}", 500}));

TEST(RepairSegmentation, VolumesOfCsgAddUp) {
  const std::vector<double> v = numbers(
      "local a = sphere{center={8, 10, 10}, radius=6}\nlocal b = sphere{center={13, 10, 10}, radius=6}\n"
      "print(volume(a), volume(b), volume(a + b), volume(a * b), volume(a - b), volume(union(a, b)))");
  ASSERT_EQ(v.size(), 6u);
  EXPECT_NEAR(v[2] + v[3], v[0] + v[1], 0.005 * v[0]);
  EXPECT_NEAR(v[4] + v[3], v[0], 0.005 * v[0]);
  EXPECT_EQ(v[5], v[2]);
}

TEST(RepairSegmentation, ABlendFillsTheCrease) {
  const std::vector<double> v = numbers(
      "local a = box{min={0, 0, 0}, max={10, 10, 10}}\n"
      "local b = {from={5, 5, 5}, to={5, 5, 20}, radius=3}\nlocal sharp = volume(a + capsule(b))\n"
      "b.blend = 2\nlocal c = capsule(b)\nprint(sharp, volume(a + c), volume(union(a, c, {blend=2})), "
      "volume(union(a, c, {blend=0})), volume(union(a, c, {blend=6})))");
  ASSERT_EQ(v.size(), 5u);
  // A fillet of radius r between plane and cylinder, cross-section (1 - pi/4) r^2, ring of radius 3 + 0.22 r.
  EXPECT_NEAR(v[1] - v[0], (1 - pi / 4) * 4 * 2 * pi * 3.45, 3);
  EXPECT_EQ(v[2], v[1]);
  EXPECT_EQ(v[3], v[0]);
  EXPECT_GT(v[4], v[1] + 20) << "wider than the band of tissues";
}

TEST(RepairSegmentation, ChangesOfAShape) {
  const std::vector<double> v = numbers(
      "local s = sphere{center={10, 10, 10}, radius=6}\n"
      "print(volume(s:offset(2)), volume(s:offset(-2)), volume(s:opening(2)), volume(s:closing(2)), "
      "volume(s:smooth{time=2, preserve='none'}), volume(s:smooth{time=2}))",
      {.gridSpacing = 0.5});
  ASSERT_EQ(v.size(), 6u);
  const auto ball = [](double radius) { return 4 * pi / 3 * radius * radius * radius; };
  EXPECT_NEAR(v[0], ball(8), 0.01 * ball(8));
  EXPECT_NEAR(v[1], ball(4), 0.02 * ball(4));
  EXPECT_NEAR(v[2], ball(6), 0.02 * ball(6)) << "two marches";
  EXPECT_NEAR(v[3], ball(6), 0.02 * ball(6));
  EXPECT_NEAR(v[4], ball(std::sqrt(36 - 8)), 0.02 * ball(6)) << "R^2 - 4 time";
  EXPECT_NEAR(v[5], ball(6), 0.005 * ball(6));
}

TEST(RepairSegmentation, PiecesAndHollows) {
  const Lines lines = test::printed(
      "local big = sphere{center={0, 0, 0}, radius=8}\nlocal small = sphere{center={20, 0, 0}, radius=3}\n"
      "local both = big + small\nlocal hollow = big - sphere{center={0, 0, 0}, radius=4}\n"
      "print(#components(both), #both:keep_largest():components(), #both:drop_small(200):components(), "
      "#both:drop_small('50vox'):components())\n"
      "print(volume(hollow:fill_cavities()) - volume(hollow) > 200, "
      "math.abs(volume(hollow:fill_cavities(100)) - volume(hollow)) < 1)\n"
      "for n, piece in ipairs(components(both)) do print(n, volume(piece) > 500) end",
      {});
  EXPECT_EQ(lines, (Lines{"2 1 1 2", "true true", "1 true", "2 false"}));
}

TEST(RepairSegmentation, MotionsKeepTheVolume) {
  const std::vector<double> v = numbers(
      "local t = tissue 'biceps'\nlocal b = box{min={0, 0, 0}, max={10, 20, 6}}\n"
      "print(volume(t), volume(t:translate{0.5, 0.25, 3}), volume(t:rotate{axis={1, 1, 0}, degrees=30}), "
      "volume(t:scale{factor=2}) / 8)\n"
      "print(volume(b), volume(b:rotate{axis={0, 0, 1}, degrees=15}))\n"
      "local c = centroid(b:rotate{axis={0, 0, 1}, degrees=90, center={0, 0, 0}})\nprint(c[1], c[2], c[3])");
  ASSERT_EQ(v.size(), 9u);
  for (const int n : {1, 2, 3}) EXPECT_NEAR(v[n], v[0], 0.02 * v[0]) << n;
  EXPECT_NEAR(v[5], v[4], 0.02 * v[4]) << "1 mm samples cut edges off";
  EXPECT_NEAR(v[6], -10, 0.05) << "a right-handed turn";
  EXPECT_NEAR(v[7], 5, 0.05);
  EXPECT_NEAR(v[8], 3, 0.05);
}

/// A cube of 10 mm, corner at the origin, as .stl; without its last triangle it is open.
void writeCube(const std::filesystem::path& file, bool open) {
  // Corner n has the coordinates of its bits: faces seen from outside, counter-clockwise.
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::ostringstream text;
  text << "solid cube\n";
  for (int n = 0; n < (open ? 11 : 12); ++n) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : {0, 1 + n % 2, 2 + n % 2}) {
      const int c = faces[n / 2][corner];
      text << "vertex " << 10 * (c & 1) << ' ' << 10 * (c >> 1 & 1) << ' ' << 10 * (c >> 2) << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid\n";
  test::writeBytes(file, text.str());
}

TEST(RepairSegmentation, ClosedSurfacesAreShapes) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder / "parts");
  writeCube(folder / "parts" / "cube.stl", false);
  writeCube(folder / "open.stl", true);
  const RepairOptions options{.meshFolder = folder.path(), .gridSpacing = 0.5};
  const std::vector<double> v = numbers(
      "local m = mesh{file='parts/cube.stl'}\nprint(volume(m), volume(m - box{min={-5, -5, -5}, max={15, 15, "
      "5}}))",
      options);
  ASSERT_EQ(v.size(), 2u);
  EXPECT_NEAR(v[0], 1000, 15) << "0.5 mm samples round edges and corners";
  EXPECT_NEAR(v[1], 500, 15);
  const std::string error = test::errorOf("mesh{file='open.stl'}", options);
  EXPECT_TRUE(error.starts_with("script.lua:1: " + (folder / "open.stl").string() + ": ")) << error;
}

TEST(RepairSegmentation, RasTurnsXAndYAround) {
  const std::vector<double> v = numbers(
      "coordinates 'RAS'\nlocal b = box{min={-10, 0, 0}, max={-5, 20, 6}}\nlocal box, c = bounds(b), "
      "centroid(b)\n"
      "print(box.min[1], box.max[1], box.min[2], box.max[2], box.size[2], c[1], c[2], c[3])\n"
      "coordinates 'LPS'\nbox = bounds(b)\nprint(box.min[1], box.max[1], box.min[2], box.max[2])");
  const std::vector<double> expected{-10, -5, 0, 20, 20, -7.5, 10, 3, 5, 10, -20, 0};
  ASSERT_EQ(v.size(), expected.size());
  for (std::size_t n = 0; n < v.size(); ++n) EXPECT_NEAR(v[n], expected[n], 0.02) << n;
}

TEST(RepairSegmentation, WhatAScriptDoesNotTouchPassesOn) {
  const Segmentation arm = smallArm();
  for (const char* script :
       {"", "local b = tissue 'biceps' + tissue 'humerus'\nprint(volume(b))",
        "save('biceps', tissue 'biceps')", "for _, t in ipairs(tissues()) do save(t.name, t) end"}) {
    const Segmentation result = repaired(script).segmentation;
    EXPECT_EQ(result.layers, arm.layers) << script;
    EXPECT_EQ(result.keys, arm.keys);
    ASSERT_EQ(result.tissues.size(), arm.tissues.size());
    for (std::size_t t = 0; t < arm.tissues.size(); ++t) {
      EXPECT_EQ(result.tissues[t].name, arm.tissues[t].name);
      EXPECT_EQ(result.tissues[t].id, arm.tissues[t].id);
      EXPECT_EQ(result.tissues[t].color, arm.tissues[t].color);
      EXPECT_EQ(result.tissues[t].tags, arm.tissues[t].tags);
    }
  }
}

TEST(RepairSegmentation, ALocalRepairChangesVoxelsNearItOnly) {
  const Segmentation arm = smallArm();
  // A bump on the end of the bone, whose edges and corners smoothing would round.
  const Segmentation result =
      repaired("save('humerus', tissue 'humerus' + sphere{center={4.5, 4.5, 17}, radius=2})").segmentation;
  EXPECT_GT(changedVoxels(arm, result), 4);
  for (int k = 0; k < 14; ++k)
    for (int n = 0; n < 400; ++n) EXPECT_EQ(result.layers[0][n + 400 * k], arm.layers[0][n + 400 * k]);
}

TEST(RepairSegmentation, SavedShapesYieldToTissuesThatAreNotSaved) {
  const RepairResult result =
      repaired("save('gap', box{min={5, 3, 5}, max={10, 8, 9}}, {color={0.9, 0.5, 0.4}})");
  const SavedTissue& gap = result.saved.at(0);
  EXPECT_EQ(gap.label, 4);
  EXPECT_EQ(gap.voxelsBefore, 0);
  ASSERT_EQ(gap.yielded.size(), 2u);
  EXPECT_EQ(gap.yielded[0].first, "humerus");
  EXPECT_EQ(voxelsOf(result.segmentation, "humerus"), voxelsOf(smallArm(), "humerus"));
  EXPECT_EQ(voxelsOf(result.segmentation, "gap"), gap.voxelsAfter);
  EXPECT_EQ(result.segmentation.tissues[3].color, (std::array{0.9, 0.5, 0.4}));
}

TEST(RepairSegmentation, PriorityTakesVoxelsAndSaysSo) {
  const RepairResult result =
      repaired("priority{'gap', 'humerus'}\nsave('gap', box{min={5, 3, 5}, max={10, 8, 9}})");
  EXPECT_TRUE(result.saved[0].yielded.empty());
  ASSERT_EQ(result.messages.size(), 2u);
  EXPECT_TRUE(result.messages[0].starts_with("'humerus' gave ")) << result.messages[0];
  EXPECT_LT(voxelsOf(result.segmentation, "humerus"), voxelsOf(smallArm(), "humerus"));
  EXPECT_EQ(test::errorOf("\npriority{'gab'}\nsave('gap', tissue 'biceps')"),
            "script.lua:2: priority: no tissue 'gab'; the nearest names are 'gap', 'biceps', 'humerus'");
}

TEST(RepairSegmentation, LayersKeepOverlaps) {
  const RepairResult result = repaired("layers()\nsave('gap', box{min={5, 3, 5}, max={10, 8, 9}})");
  EXPECT_EQ(result.segmentation.layers.size(), 2u);
  EXPECT_EQ(result.segmentation.layers[0], smallArm().layers[0]);
  EXPECT_EQ(result.saved[0].layer, 1);
}

TEST(RepairSegmentation, RemovesTissues) {
  const RepairResult result = repaired("remove 'spec*'\nsave('biceps', tissue 'biceps')\nremove 'biceps'");
  EXPECT_EQ(result.removed, (Lines{"biceps", "speckle"}));
  EXPECT_EQ(result.segmentation.tissues.size(), 1u);
  EXPECT_TRUE(result.saved.empty());
  EXPECT_EQ(repaired("remove 'x*'").messages, Lines{"remove \"x*\": there is none"});
}

TEST(RepairSegmentation, ANameThatMayBeASlipIsTold) {
  EXPECT_EQ(
      repaired("save('Biceps', tissue 'biceps')").messages,
      (Lines{"save \"Biceps\": a new tissue; 'biceps' stays as it is", "'Biceps' is saved without a voxel"}));
}

TEST(RepairSegmentation, OperationsAreReported) {
  const RepairResult result = repaired(
      "local b = tissue 'biceps'\n\nb = b - sphere{center={10.5, 6.5, 9.5}, radius=1.8}\nsave('biceps', b)");
  ASSERT_EQ(result.operations.size(), 1u);
  const RepairOperation& operation = result.operations[0];
  EXPECT_EQ(operation.line, 3);
  EXPECT_EQ(operation.operation, "-");
  EXPECT_EQ(operation.tissue, "biceps");
  ASSERT_TRUE(operation.before && operation.after);
  EXPECT_NEAR(operation.before->volume - operation.after->volume, 4 * pi / 3 * 1.8 * 1.8 * 1.8, 2)
      << "1 mm samples";
  EXPECT_EQ(operation.before->topology, (ShapeTopology{1, 0}));
  EXPECT_EQ(operation.after->topology, (ShapeTopology{1, 1}));
}

TEST(RepairSegmentation, WhatGoesWrongAtSavingIsToldWithTheLineThatSaved) {
  RepairOptions options;
  options.limits.shapeBytes = 10'000'000;
  EXPECT_EQ(test::errorOf("local s = sphere{center={0, 0, 0}, radius=500}\n\nsave('a', s)", options),
            "script.lua:3: save \"a\": the shapes of the script take more than 10 MB; make them smaller, or "
            "--grid larger");
}

TEST(RepairSegmentation, CheckingTurnsWhatHasNoEndAsFarAsTheImageGoes) {
  const std::string script =
      "local t = tissue 'biceps' + halfspace{point={0, 0, 0}, normal={0, 0, 1}}\n"
      "save('biceps', t:rotate{axis={0, 0, 1}, degrees=10})";
  EXPECT_EQ(repaired(script, {.check = true}).saved.size(), 1u);
  EXPECT_EQ(repaired(script).saved.size(), 1u);
}

TEST(RepairSegmentation, CheckingComputesNothing) {
  RepairOptions options{.check = true};
  options.limits.shapeBytes = 0;  // not one level set
  const std::string script =
      "local b = (tissue 'biceps' + tissue 'humerus'):smooth{time=1}\nsave('biceps', b)";
  const RepairResult result = repaired(script, options);
  EXPECT_TRUE(result.operations.empty());
  EXPECT_TRUE(result.segmentation.layers.empty());
  ASSERT_EQ(result.saved.size(), 1u);
  EXPECT_EQ(result.saved[0].name, "biceps");
  options.check = false;
  EXPECT_EQ(
      test::errorOf(script, options),
      "script.lua:1: the shapes of the script take more than 0 MB; make them smaller, or --grid larger");
}

TEST(RepairSegmentation, CheckingEstimatesFromVoxels) {
  Segmentation arm = smallArm();
  arm.layers[0][399] = 1;  // a second piece of the bone, at (19, 19, 0)
  updateTissueTable(arm);
  Lines lines;
  const RepairOptions options{.check = true,
                              .print = [&](const std::string& line) { lines.push_back(line); }};
  repairSegmentation(
      arm,
      "local t = tissue 'humerus'\nlocal pieces = components(t)\n"
      "print(volume(t), #pieces, volume(pieces[1]), bounds(pieces[2]).min, #components(t:offset(1)))",
      options);
  EXPECT_EQ(lines, Lines{"257 2 256 {18.5, 18.5, -0.5} 1"});
}

TEST(RepairSegmentation, ShapesBeyondTheMemoryAreRefused) {
  RepairOptions options;
  options.limits.shapeBytes = 1'000'000;
  const std::string reason =
      "the shapes of the script take more than 1 MB; make them smaller, or --grid larger";
  EXPECT_EQ(test::errorOf("print(volume(sphere{center={0, 0, 0}, radius=500}))", options),
            "script.lua:1: " + reason);
  EXPECT_EQ(test::errorOf("print(volume(union(tissue 'biceps', tissue 'humerus', {blend=1000})))", options),
            "script.lua:1: " + reason);
  EXPECT_EQ(test::errorOf("local kept = {}\nfor i = 1, 1000 do\n  kept[i] = tissue 'biceps':offset(1)\nend",
                          options),
            "script.lua:3: " + reason);
  EXPECT_EQ(test::errorOf("for i = 1, 60 do\n  local lost = tissue 'biceps':offset(0.1)\nend", options), "")
      << "what nobody can reach is let go";
}

TEST(RepairSegmentation, TheResultDoesNotDependOnTheNumberOfThreads) {
  const std::string script =
      "local b = tissue 'biceps' + capsule{from={11, 7, 10}, to={16, 12, 16}, radius=3, blend=2}\n"
      "b = (b - tissue('humerus'):offset(0.5)):smooth{time=1, preserve='volume'}\nsave('biceps', b)";
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return repaired(script, {.levelSets = true});
  };
  const RepairResult one = with(1), four = with(4);
  EXPECT_EQ(one.segmentation.layers, four.segmentation.layers);
  EXPECT_EQ(one.saved[0].levelSet->phi.values, four.saved[0].levelSet->phi.values);
  EXPECT_EQ(one.operations.back().after->volume, four.operations.back().after->volume);
}

TEST(RepairSegmentation, TissuesByNameIdLabelAndPattern) {
  EXPECT_EQ(test::printed(
                "print(tissue('Humerus').name, tissue(2).name, tissue('Segment_3').name)\n"
                "local s = ''\nfor _, t in ipairs(tissues '*ep*') do s = s .. t.name .. ' ' end\nprint(s, "
                "#tissues(), #tissues '?umerus')"),
            (Lines{"humerus biceps speckle", "biceps  3 1"}));
}

}  // namespace
}  // namespace sinew
