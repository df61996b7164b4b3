#include "SampleSegmentation.h"
#include "TestImages.h"
#include "sinew/Segmentation/NearestNames.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkNrrdImageIOFactory.h>

#include <algorithm>
#include <map>

/// What 3D Slicer's sources say of its segmentation files, line by line (S1 to S8 of the checklist of
/// exchange: what is read).
namespace sinew {
namespace {

using test::NrrdSpec;

/// `SegmentN_key:=value` lines.
std::string segmentLines(int n, const std::map<std::string, std::string>& keys) {
  std::string lines;
  for (const auto& [key, value] : keys)
    lines.append("Segment")
        .append(std::to_string(n))
        .append("_" + key)
        .append(":=")
        .append(value)
        .append("\n");
  return lines;
}

std::string small(NrrdSpec spec, const std::string& lines) {
  spec.extra += lines;
  return test::nrrd(spec, test::bytesOf(test::smallLabelsAs<std::int16_t>()));
}

std::string slicerErrorOf(const std::string& bytes) {
  return test::messageOf<std::runtime_error>([&] { test::segmentationFrom("a.seg.nrrd", bytes); });
}

TEST(SegmentationFiles, S1_OneLayerEqualsItsHeaderInLpsAndRas) {
  const std::string lines = segmentLines(0, {{"ID", "Segment_9"},
                                             {"Name", "left kidney"},
                                             {"Color", "0.25 0.5 1"},
                                             {"LabelValue", "7"},
                                             {"Layer", "0"},
                                             {"Tags", "a:b|TerminologyEntry:x~SCT^1^y:z|"}});
  const auto in = [&](const std::string& space) {
    return test::segmentationFrom("a.seg.nrrd",
                                  small({.geometry = "space: " + space +
                                                     "\nspace directions: (1,0,0) (0,1,0) (0,0,2)\n"
                                                     "space origin: (-70.5,20,30)\n"},
                                        lines));
  };
  const Segmentation lps = in("left-posterior-superior"), ras = in("right-anterior-superior");
  for (const Segmentation* s : {&lps, &ras}) {
    ASSERT_EQ(s->tissues.size(), 3u);
    const Tissue& kidney = s->tissues[2];
    EXPECT_EQ(kidney.id, "Segment_9");
    EXPECT_EQ(kidney.name, "left kidney");
    EXPECT_EQ(kidney.label, 7);
    EXPECT_EQ(kidney.layer, 0);
    EXPECT_EQ(kidney.color, (std::array<double, 3>{0.25, 0.5, 1}));
    EXPECT_EQ(kidney.tags.at("TerminologyEntry"), "x~SCT^1^y:z");
    EXPECT_EQ(kidney.tags.at("a"), "b");
  }
  EXPECT_EQ(lps.geometry.indexToPhysical() * Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-69.5, 21, 32));
  EXPECT_EQ(ras.geometry.indexToPhysical() * Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(69.5, -21, 32));
}

TEST(SegmentationFiles, S2_ASegmentIsItsLabelOnItsLayer) {
  NrrdSpec spec{
      .type = "unsigned char",
      .dimension = "4",
      .sizes = "2 3 1 2",
      .geometry = "space: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,2)\nspace origin: (0,0,0)\n",
      .kinds = "list domain domain domain",
      .extra = segmentLines(0, {{"ID", "a"}, {"Layer", "0"}, {"LabelValue", "1"}}) +
               segmentLines(1, {{"ID", "b"}, {"Layer", "1"}, {"LabelValue", "1"}}) +
               segmentLines(2, {{"ID", "c"}, {"Layer", "1"}, {"LabelValue", "2"}})};
  const Segmentation s =
      test::segmentationFrom("a.seg.nrrd", test::nrrd(spec, {1, 1, 1, 0, 0, 1, 1, 2, 0, 0, 0, 2}));
  ASSERT_EQ(s.tissues.size(), 3u);
  EXPECT_EQ(s.layers[0], (std::vector<std::int32_t>{1, 1, 0, 1, 0, 0}));
  EXPECT_EQ(s.layers[1], (std::vector<std::int32_t>{1, 0, 1, 2, 0, 2}));
  EXPECT_EQ(s.tissues[0].id + s.tissues[1].id + s.tissues[2].id, "abc");
  EXPECT_EQ(s.tissues[0].voxels, 3);
  EXPECT_EQ(s.tissues[1].voxels, 2);
  EXPECT_EQ(s.tissues[2].voxels, 2);
}

TEST(SegmentationFiles, S3_ToldByItsContentUnderAnyName) {
  const std::string bytes = small({}, segmentLines(0, {{"ID", "a"}, {"Name", "bone"}}));
  for (const char* name : {"a.nrrd", "ABCDE_vtkMRMLSegmentationNode.nrrd", "a.nhdr", "a.dat", "a"})
    EXPECT_EQ(test::segmentationFrom(name, bytes).tissues[0].name, "bone") << name;
}

TEST(SegmentationFiles, S4_WhatIsMissingIsAsInSlicer) {
  const Segmentation s = test::segmentationFrom(
      "a.nrrd",
      small({}, segmentLines(0, {{"ID", "only"}}) + segmentLines(2, {{"ID", "late"}, {"LabelValue", "7"}})));
  EXPECT_EQ(s.tissues[0].name, "only");
  EXPECT_EQ(s.tissues[0].label, 1);
  EXPECT_EQ(s.tissues[0].layer, 0);
  EXPECT_EQ(s.tissues[0].color, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ(s.tissues[2].name, "Segment_7") << "reading stops at the first missing ID";
  EXPECT_EQ(
      test::segmentationFrom("b.nrrd", small({}, segmentLines(0, {{"ID", "x"}, {"DefaultColor", "0 1 0"}})))
          .tissues[0]
          .color,
      (std::array<double, 3>{0, 1, 0}));
  const std::string error =
      slicerErrorOf(small({}, segmentLines(0, {{"ID", "a"}}) + segmentLines(1, {{"ID", "fat"}})));
  EXPECT_NE(error.find("segment `fat` lies on layer 1"), std::string::npos) << error;
}

TEST(SegmentationFiles, S5_ReferenceImageExtentOffsetMovesNothing) {
  itk::NrrdImageIOFactory::RegisterOneFactory();
  const test::TempFolder folder;
  test::writeBytes(
      folder / "a.nrrd",
      small({.geometry = "space: LPS\nspace directions: (0.6,0.8,0) (-0.8,0.6,0) (0,0,2.5)\n"
                         "space origin: (-70.5,20,30)\n"},
            "Segmentation_ReferenceImageExtentOffset:=5 -6 7\n" + segmentLines(0, {{"ID", "a"}})));
  const Segmentation s = readSegmentation(folder / "a.nrrd");
  const auto image = itk::ReadImage<itk::Image<float, 3>>((folder / "a.nrrd").string());
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        const auto point = image->TransformIndexToPhysicalPoint<double>({{i, j, k}});
        const Eigen::Vector3d ours = s.geometry.indexToPhysical() * Eigen::Vector3d(i, j, k);
        // A few roundings of numbers below 100 mm.
        EXPECT_LT((ours - Eigen::Vector3d(point[0], point[1], point[2])).norm(), 1e-13);
        EXPECT_EQ(s.at(0, {i, j, k}), image->GetPixel({{i, j, k}}));
      }
}

TEST(SegmentationFiles, S6_PlainLabelMapsAreNamedByTheTable) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  const std::map<std::string, std::string> images{{"a.nrrd", test::nrrd({}, raw)},
                                                  {"a.nii.gz", test::gzip(test::nifti({}, raw))},
                                                  {"a.mha", test::meta({}, raw)}};
  const std::map<std::string, std::string> tables{
      {"slicer.ctbl", "1 left_kidney 255 0 51 255\n"},
      {"slicer.csv", "LabelValue,Name,Color_R,Color_G,Color_B,Color_A\n1,left kidney,255,0,51,255\n"},
      {"bids.tsv", "index\tname\tcolor\n1\tleft kidney\t#ff0033\n"},
      {"freesurfer.txt", "#No. Label Name: R G B A\n1  Left-Kidney  255 0 51 0\n"},
      {"snap.txt", "1 255 0 51 1 1 1 \"left kidney\"\n"}};
  for (const auto& [imageName, image] : images) {
    const test::TempFolder folder;
    test::writeBytes(folder / imageName, image);
    const Segmentation plain = readSegmentation(folder / imageName);
    EXPECT_EQ(plain.tissues[0].name, "Segment_1");
    EXPECT_EQ(plain.tissues[2].name, "Segment_7");
    for (const auto& [tableName, table] : tables) {
      SCOPED_TRACE(imageName + " " + tableName);
      test::writeBytes(folder / tableName, table);
      const Segmentation named = readSegmentation(folder / imageName, {.lut = folder / tableName});
      EXPECT_EQ(looseName(named.tissues[0].name), "left kidney");
      EXPECT_EQ(named.tissues[0].color, (std::array<double, 3>{1, 0, 0.2}));
      EXPECT_EQ(named.tissues[1].name, "Segment_2");
    }
  }
}

TEST(SegmentationFiles, S7_ComponentsNeverMix) {
  for (const int layers : {2, 3, 4, 8}) {
    SCOPED_TRACE(layers);
    const Segmentation s = test::sampleSegmentation(layers);
    const Segmentation read = test::writtenAndRead(s);
    EXPECT_EQ(read.layers, s.layers);
  }
}

TEST(SegmentationFiles, S8_NothingToSeeIsSaid) {
  const NrrdSpec one{.sizes = "1 1 1"};
  EXPECT_NE(slicerErrorOf(test::nrrd(one, std::string(2, '\0'))).find("holds a single voxel"),
            std::string::npos);
  const std::string nothing(48, '\0');
  EXPECT_NE(
      slicerErrorOf(test::nrrd({.extra = "Segmentation_MasterRepresentation:=Binary labelmap\n"}, nothing))
          .find("no voxel other than 0"),
      std::string::npos);
  EXPECT_NE(slicerErrorOf(
                test::nrrd({.extra = segmentLines(0, {{"ID", "a"}, {"Extent", "0 -1 0 -1 0 -1"}})}, nothing))
                .find("no voxel other than 0"),
            std::string::npos);
}

TEST(SegmentationFiles, ExtentsCropTheirLayerAsInSlicerAndItIsSaid) {
  const auto with = [](const std::string& first, const std::string& second) {
    return test::segmentationFrom(
        "a.seg.nrrd",
        small({},
              segmentLines(0, {{"ID", "a"}, {"Layer", "0"}, {"LabelValue", "1"}, {"Extent", first}}) +
                  segmentLines(1, {{"ID", "b"}, {"Layer", "0"}, {"LabelValue", "7"}, {"Extent", second}})));
  };
  const Segmentation whole = with("0 3 0 2 0 1", "1 2 1 1 0 0");
  EXPECT_EQ(whole.layers[0], test::smallLabels());
  EXPECT_TRUE(whole.warnings.empty());

  const Segmentation cropped = with("1 2 0 1 0 0", "3 3 1 2 0 0");  // together 1..3, 0..2, 0
  std::vector<std::int32_t> expected = test::smallLabels();
  for (std::size_t voxel = 0; voxel < expected.size(); ++voxel)
    if (voxel % 4 == 0 || voxel >= 12) expected[voxel] = 0;
  EXPECT_EQ(cropped.layers[0], expected);
  ASSERT_EQ(cropped.warnings.size(), 1u);
  EXPECT_NE(cropped.warnings[0].find("5 voxels of layer 0 lie outside"), std::string::npos)
      << cropped.warnings[0];

  EXPECT_TRUE(with("0 -1 0 -1 0 -1", "-2000000000 2000000000 0 9 -3 1").warnings.empty())
      << "reaches out: all";
  EXPECT_EQ(with("nonsense", "").layers[0], test::smallLabels());
  const std::string error =
      slicerErrorOf(small({}, segmentLines(0, {{"ID", "a"}, {"Extent", "0 -1 0 -1 0 -1"}})));
  EXPECT_NE(error.find("has no voxel inside of the Extents of its segments"), std::string::npos) << error;
}

}  // namespace
}  // namespace sinew
