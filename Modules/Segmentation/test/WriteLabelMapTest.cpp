#include "SampleSegmentation.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/Segmentation/WriteLabelMap.h"
#include "sinew/Segmentation/WriteLabelTable.h"

#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIOFactory.h>
#include <itkNiftiImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>

#include <cstring>

namespace sinew {
namespace {

const std::vector<std::string> kEndings{".nrrd", ".nii", ".nii.gz", ".mha", ".mhd"};

bool isNifti(const std::string& ending) { return ending.starts_with(".nii"); }

/// A NIfTI header holds single precision: 6e-8 of coordinates up to 150 mm, and a quaternion without its real
/// part, which ITK reads first.
double toleranceMm(const std::string& ending) { return isNifti(ending) ? 1e-4 : 1e-11; }

Segmentation tiltedPhantom() {
  Segmentation s = makePhantom("sphere", {.spacing = Eigen::Vector3d(1.1, 0.7, 2.3), .tiltDeg = 17});
  s.geometry.origin += Eigen::Vector3d(-103.3, 57.7, 1000.0 / 7);
  return s;
}

/// Whether voxel indices lie at the same places, to the far corner of the image.
void expectSamePlaces(const ImageGeometry& a, const ImageGeometry& b, double toleranceMm) {
  ASSERT_EQ(a.size, b.size);
  for (const Eigen::Vector3d& index :
       {Eigen::Vector3d::Zero().eval(), a.size.cast<double>().eval(), Eigen::Vector3d(a.size.x(), 0, 0)})
    EXPECT_LT((a.indexToPhysical() * index - b.indexToPhysical() * index).norm(), toleranceMm);
}

TEST(WriteLabelMap, EveryFormatReadsBackTheSame) {
  const Segmentation s = tiltedPhantom();
  for (const std::string& ending : kEndings) {
    SCOPED_TRACE(ending);
    const test::TempFolder folder;
    const auto file = folder / ("a" + ending);
    const LabelMapReport report = writeLabelMap(s, file);
    const Segmentation read = readSegmentation(file);
    EXPECT_EQ(read.layers, s.layers);
    expectSamePlaces(read.geometry, s.geometry, toleranceMm(ending));
    ASSERT_EQ(report.table.size(), s.tissues.size());
    EXPECT_EQ(report.table.begin()->second.name, s.tissues[0].name);
    EXPECT_TRUE(report.changes.empty());
  }
}

TEST(WriteLabelMap, ItkReadsTheSamePlaces) {
  itk::NrrdImageIOFactory::RegisterOneFactory();
  itk::NiftiImageIOFactory::RegisterOneFactory();
  itk::MetaImageIOFactory::RegisterOneFactory();
  const Segmentation s = tiltedPhantom();
  for (const std::string& ending : kEndings) {
    SCOPED_TRACE(ending);
    const test::TempFolder folder;
    writeLabelMap(s, folder / ("a" + ending));
    const auto image = itk::ReadImage<itk::Image<int, 3>>((folder / ("a" + ending)).string());
    const itk::Index<3> last{{s.geometry.size.x() - 1, s.geometry.size.y() - 1, s.geometry.size.z() - 1}};
    for (const itk::Index<3>& index : {itk::Index<3>{{0, 0, 0}}, last}) {
      const auto point = image->TransformIndexToPhysicalPoint<double>(index);
      const Eigen::Vector3d ours =
          s.geometry.indexToPhysical() * Eigen::Vector3d(index[0], index[1], index[2]);
      EXPECT_LT((ours - Eigen::Vector3d(point[0], point[1], point[2])).norm(), toleranceMm(ending));
    }
    std::size_t voxel = 0, different = 0;
    for (const int* value = image->GetBufferPointer(); voxel < s.layers[0].size(); ++voxel)
      different += value[voxel] != s.layers[0][voxel];
    EXPECT_EQ(different, 0u);
  }
}

TEST(WriteLabelMap, SmallestTypeThatHoldsTheLabels) {
  for (const std::int32_t label : {255, 256, -1, 32768, 65536, INT32_MIN, INT32_MAX})
    for (const std::string& ending : kEndings) {
      SCOPED_TRACE(std::to_string(label) + ending);
      Segmentation s = test::sampleSegmentation();
      s.layers[0][5] = label;
      updateTissueTable(s);
      const test::TempFolder folder;
      writeLabelMap(s, folder / ("a" + ending));
      EXPECT_EQ(readSegmentation(folder / ("a" + ending)).layers, s.layers);
      if (ending != ".nii") continue;
      EXPECT_EQ(std::filesystem::file_size(folder / "a.nii"),
                352 + 24 * (label == 255                  ? 1u
                            : label > 65535 || label < -1 ? 4u
                                                          : 2u));
    }
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string niftiOf(const Segmentation& s) {
  const test::TempFolder folder;
  writeLabelMap(s, folder / "a.nii");
  return test::readBytes(folder / "a.nii");
}

Eigen::Matrix<double, 3, 4> sformOf(const std::string& nifti) {
  Eigen::Matrix<double, 3, 4> rows;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      rows(row, column) = at<float>(nifti, 280 + 16 * row + 4 * column);
  return rows;
}

/// NIfTI's quaternion formula, from nifti1.h.
Eigen::Matrix<double, 3, 4> qformOf(const std::string& nifti) {
  const double b = at<float>(nifti, 256), c = at<float>(nifti, 260), d = at<float>(nifti, 264);
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  Eigen::Matrix<double, 3, 4> rows;
  rows << a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), at<float>(nifti, 268),
      2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), at<float>(nifti, 272),
      2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c, at<float>(nifti, 276);
  rows.col(2) *= at<float>(nifti, 76);
  for (int axis = 0; axis < 3; ++axis) rows.col(axis) *= at<float>(nifti, 80 + 4 * axis);
  return rows;
}

TEST(WriteLabelMap, NiftisQformAndSformSayTheSame) {
  Segmentation s = test::sampleSegmentation();
  for (const bool mirrored : {false, true}) {
    if (mirrored) s.geometry.direction.col(1) *= -1;
    const std::string nifti = niftiOf(s);
    EXPECT_EQ(at<std::int16_t>(nifti, 252), 1);
    EXPECT_EQ(at<std::int16_t>(nifti, 254), 1);
    Eigen::Matrix<double, 3, 4> expected = s.geometry.indexToPhysical().matrix().topRows<3>();
    expected.topRows<2>() *= -1;  // RAS
    EXPECT_LT((sformOf(nifti) - expected).norm(), 1e-5) << "single precision of 143 mm";
    EXPECT_LT((qformOf(nifti) - expected).norm(), 1e-5);
  }
}

TEST(WriteLabelMap, ShearedAxesFitOnlyASform) {
  Segmentation s = test::sampleSegmentation();
  s.geometry.direction.col(2) =
      (s.geometry.direction.col(2) + 0.1 * s.geometry.direction.col(0)).normalized();
  const std::string nifti = niftiOf(s);
  EXPECT_EQ(at<std::int16_t>(nifti, 252), 0);
  EXPECT_EQ(at<std::int16_t>(nifti, 254), 1);
  for (const std::string& ending : kEndings) {
    SCOPED_TRACE(ending);
    const test::TempFolder folder;
    writeLabelMap(s, folder / ("a" + ending));
    expectSamePlaces(readSegmentation(folder / ("a" + ending)).geometry, s.geometry, 1e-5);
  }
}

TEST(WriteLabelMap, SameBytesEveryTime) {
  for (const std::string& ending : kEndings) {
    const test::TempFolder one, two;
    writeLabelMap(test::sampleSegmentation(), one / ("a" + ending));
    writeLabelMap(test::sampleSegmentation(), two / ("a" + ending));
    EXPECT_EQ(test::readBytes(one / ("a" + ending)), test::readBytes(two / ("a" + ending))) << ending;
  }
}

TEST(WriteLabelMap, EveryFormatIsOneFileThatCanBeRenamed) {
  for (const std::string& ending : kEndings) {
    const test::TempFolder folder;
    writeLabelMap(test::sampleSegmentation(), folder / ("a" + ending));
    std::filesystem::rename(folder / ("a" + ending), folder / ("b" + ending));
    EXPECT_EQ(readSegmentation(folder / ("b" + ending)).layers, test::sampleSegmentation().layers) << ending;
  }
}

TEST(WriteLabelMap, FaultsAreNamed) {
  const test::TempFolder folder;
  const Segmentation s = test::sampleSegmentation();
  EXPECT_TRUE(isLabelMapName("a.NII.GZ"));
  EXPECT_FALSE(isLabelMapName("a.seg.nrrd"));
  EXPECT_FALSE(isLabelMapName("a.gz"));
  EXPECT_EQ(test::messageOf<std::invalid_argument>([&] { writeLabelMap(s, "a.gz"); }),
            "writeLabelMap: a.gz ends in none of .nrrd, .nii, .nii.gz, .mha, .mhd");
  for (const std::string& ending : kEndings)
    EXPECT_NE(test::messageOf<std::runtime_error>([&] {
                writeLabelMap(s, folder / ("no/a" + ending));
              }).find("cannot be created"),
              std::string::npos);
  Segmentation wide = s;
  wide.geometry.size = {40000, 1, 1};
  wide.layers = {std::vector<std::int32_t>(40000, 1)};
  EXPECT_NE(test::messageOf<std::runtime_error>([&] {
              writeLabelMap(wide, folder / "a.nii");
            }).find("an axis has 40000 voxels, NIfTI-1 holds 32767; write .nrrd or .mha"),
            std::string::npos);
}

// ---- layers

/// Voxels 0 1 2 3 of a row: `a` has 0 1, `b` has 1 2 on the next layer with the same label, and `c` 3.
Segmentation overlapping() {
  Segmentation s;
  s.geometry.size = {4, 1, 1};
  s.source = "in.seg.nrrd";
  s.layers = {{1, 1, 0, 0}, {0, 1, 1, 2}};
  s.tissues = {test::sampleTissue("a", 0, 1), test::sampleTissue("b", 1, 1), test::sampleTissue("c", 1, 2)};
  updateTissueTable(s);
  return s;
}

Segmentation apart() {
  Segmentation s = overlapping();
  s.layers[0][1] = 0;
  updateTissueTable(s);
  return s;
}

TEST(MergeLayers, LayersWithoutOverlapGetDistinctLabels) {
  const test::TempFolder folder;
  const LabelMapReport report = writeLabelMap(apart(), folder / "a.mha");
  EXPECT_EQ(readSegmentation(folder / "a.mha").layers[0], (std::vector<std::int32_t>{1, 3, 3, 2}));
  ASSERT_EQ(report.changes.size(), 1u);
  EXPECT_EQ(report.changes[0].name, "b");
  EXPECT_EQ(report.changes[0].layer, 1);
  EXPECT_EQ(report.changes[0].from, 1);
  EXPECT_EQ(report.changes[0].to, 3);
  EXPECT_EQ(report.contestedVoxels, 0);
  EXPECT_EQ(report.table.at(3).name, "b");
  EXPECT_EQ(report.table.at(2).name, "c");
}

TEST(MergeLayers, OverlapIsRefusedWithBothNamesAndTheRemedy) {
  const test::TempFolder folder;
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { writeLabelMap(overlapping(), folder / "a.nii.gz"); }),
            "in.seg.nrrd: `a` and `b` overlap, first in voxel (1, 0, 0), and one layer holds one tissue per "
            "voxel; write a .seg.nrrd, which keeps both, or say which tissue comes first (--priority)");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(MergeLayers, APriorityDecidesAndTheRestComesAsInTheTable) {
  const auto merged = [](std::vector<std::string> priority) {
    return mergeLayers(overlapping(), {.priority = std::move(priority)});
  };
  EXPECT_EQ(merged({"b"}).segmentation.layers[0], (std::vector<std::int32_t>{1, 3, 3, 2}));
  EXPECT_EQ(merged({"a", "b"}).segmentation.layers[0], (std::vector<std::int32_t>{1, 1, 3, 2}));
  EXPECT_EQ(merged({"id of b"}).segmentation.layers[0], (std::vector<std::int32_t>{1, 3, 3, 2}));
  const MergedLayers asInTheTable = merged({});
  EXPECT_EQ(asInTheTable.segmentation.layers[0], (std::vector<std::int32_t>{1, 1, 3, 2}));
  EXPECT_EQ(asInTheTable.contestedVoxels, 1);
  EXPECT_EQ(asInTheTable.segmentation.tissues.size(), 3u);
  EXPECT_NE(test::messageOf<std::invalid_argument>([&] { merged({"liver"}); }).find("no tissue 'liver'"),
            std::string::npos);
}

TEST(MergeLayers, ATissueThatLosesAllIsEmptyAndEmptyOnesKeepTheirs) {
  Segmentation s = overlapping();
  s.layers[1] = {0, 1, 0, 0};
  s.emptyTissues.push_back(test::sampleTissue("nothing", 1, 7));
  updateTissueTable(s);
  const MergedLayers merged = mergeLayers(s, {.priority = std::vector<std::string>{"a"}});
  ASSERT_EQ(merged.segmentation.tissues.size(), 1u);
  ASSERT_EQ(merged.segmentation.emptyTissues.size(), 3u);
  std::vector<std::int32_t> labels{merged.segmentation.tissues[0].label};
  for (const Tissue& tissue : merged.segmentation.emptyTissues) labels.push_back(tissue.label);
  EXPECT_EQ(labels, (std::vector<std::int32_t>{1, 2, 3, 7}));
}

TEST(WriteLabelTable, SlicersTablesRefuseLabelsThatSlicerRefuses) {
  const test::TempFolder folder;
  for (const char* name : {"a.ctbl", "a.csv"})
    for (const std::int32_t label : {-1, 1'000'001})
      EXPECT_NE(test::messageOf<std::runtime_error>([&] {
                  writeLabelTable({{label, {.name = "bone"}}}, folder / name);
                }).find("`bone` has " + std::to_string(label)),
                std::string::npos);
  writeLabelTable({{-1, {.name = "bone"}}}, folder / "a.tsv");
  EXPECT_EQ(readLabelTable(folder / "a.tsv").at(-1).name, "bone");
  EXPECT_THROW(writeLabelTable({}, folder / "a.txt"), std::invalid_argument);
}

TEST(WriteLabelTable, WhatOtherProgramsSeeOfIt) {
  const test::TempFolder folder;
  const LabelTable table{
      {7,
       {.name = "left_kidney, big", .color = {1, 0, 0.2}, .terminology = "list~SCT^1^Tissue~SCT^2^Kidney"}}};
  const auto written = [&](const std::string& name) {
    writeLabelTable(table, folder / name);
    return test::readBytes(folder / name);
  };
  EXPECT_EQ(written("a.ctbl"),
            "# Color table file\n# 1 values\n# label 7 is named \"left_kidney, big\"\n"
            "7 left_kidney,_big 255 0 51 255\n");
  EXPECT_EQ(written("a_dseg.tsv"), "index\tname\tcolor\n7\tleft_kidney, big\t#ff0033\n");
  const std::string csv = written("a.csv");
  EXPECT_TRUE(csv.starts_with("LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Category_CodingScheme,"));
  EXPECT_TRUE(csv.ends_with("\n7,\"left_kidney, big\",255,0,51,255,SCT,1,Tissue,SCT,2,Kidney,,,,,,,,,\n"))
      << csv;
}

}  // namespace
}  // namespace sinew
