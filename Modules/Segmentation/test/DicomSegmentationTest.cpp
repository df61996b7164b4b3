#include "DicomBuilder.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sinew {
namespace {

using test::DicomSpec;
using test::kA;
using test::kB;
using test::kC;
using test::labelMap;
using test::oneFrame;
using test::times;

Segmentation read(const DicomSpec& spec, const ReadSegmentationOptions& options = {}) {
  const test::TempFolder folder;
  test::writeDicom(folder / "a.dcm", spec);
  return readSegmentation(folder / "a.dcm", options);
}

std::vector<std::int32_t> slice(const Segmentation& s, int layer, int k) {
  const auto first = s.layers[layer].begin() + std::ptrdiff_t{12} * k;
  return {first, first + 12};
}

TEST(DicomSegmentation, VoxelsNameColourAndCodes) {
  DicomSpec spec = oneFrame();
  spec.segments[0].label = "linke Niere \xC3\xBC";
  const Segmentation s = read(spec);
  EXPECT_EQ(s.layers, (std::vector<std::vector<std::int32_t>>{times(kA, 1)}));
  ASSERT_EQ(s.tissues.size(), 1u);
  const Tissue& kidney = s.tissues[0];
  EXPECT_EQ(kidney.name, "linke Niere \xC3\xBC");
  EXPECT_EQ(kidney.id, "Segment_1");
  EXPECT_TRUE(kidney.named);
  EXPECT_EQ(
      kidney.tags.at("TerminologyEntry"),
      "Segmentation category and type - DICOM master list~SCT^123037004^Anatomical Structure~SCT^64033007^"
      "Kidney~SCT^7771000^Left~Anatomic codes - DICOM master list~^^~^^");
  // DICOM keeps 16 bits of L*a*b*; the spec's are rounded to 0.1.
  EXPECT_NEAR(kidney.color[0], 1, 0.01);
  EXPECT_NEAR(kidney.color[1], 0, 0.03);
  EXPECT_NEAR(kidney.color[2], 0, 0.03);
  EXPECT_EQ(s.geometry.spacing, Eigen::Vector3d(0.5, 0.7, 2));
  EXPECT_EQ(s.geometry.origin, Eigen::Vector3d(10, 20, 30));
}

TEST(DicomSegmentation, ToldByItsContentAndConvertedToSlicersFormat) {
  const test::TempFolder folder;
  test::writeDicom(folder / "IM000001", oneFrame());
  const Segmentation s = readSegmentation(folder / "IM000001");
  writeSegmentation(s, folder / "a.seg.nrrd");
  const Segmentation again = readSegmentation(folder / "a.seg.nrrd");
  EXPECT_EQ(again.layers, s.layers);
  EXPECT_EQ(again.tissues[0].name, "bone");
  EXPECT_EQ(again.tissues[0].tags, s.tissues[0].tags);
  EXPECT_EQ(again.tissues[0].color, s.tissues[0].color);
}

TEST(DicomSegmentation, MissingFramesAreBackgroundInWhateverOrderTheyCome) {
  DicomSpec spec;
  spec.segments = {{.number = 1}, {.number = 2, .label = "fat"}, {.number = 9, .label = "no frame"}};
  spec.frames = {{2, 4, kB}, {1, 4, kA}, {1, 1, kB}, {2, -1, kA}};
  const Segmentation s = read(spec);
  EXPECT_EQ(s.geometry.size, Eigen::Vector3i(4, 3, 6));
  EXPECT_EQ(s.geometry.origin, Eigen::Vector3d(10, 20, 28));
  EXPECT_EQ(s.geometry.spacing.z(), 2);
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_EQ(slice(s, 0, 0), times(kA, 2));
  EXPECT_EQ(slice(s, 0, 1), times(kA, 0));
  EXPECT_EQ(slice(s, 0, 2), times(kB, 1));
  std::vector<std::int32_t> both = times(kA, 1);
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += 2 * kB[i];
  EXPECT_EQ(slice(s, 0, 5), both);
  ASSERT_EQ(s.emptyTissues.size(), 1u);
  EXPECT_EQ(s.emptyTissues[0].name, "no frame");
}

TEST(DicomSegmentation, TheSpacingIsThatOfThePositions) {
  for (const char* said : {"", "1.7", "1"}) {  // missing, wrong, and a divisor: slices are missing
    DicomSpec spec = oneFrame();
    spec.sliceSpacing = said;
    spec.frames.push_back({1, 1, kB});
    spec.frames.push_back({1, 3, kB});
    const Segmentation s = read(spec);
    EXPECT_EQ(s.geometry.spacing.z(), said == std::string("1") ? 1 : 2) << said;
    EXPECT_EQ(s.geometry.size.z(), said == std::string("1") ? 7 : 4) << said;
  }
}

TEST(DicomSegmentation, TiltedAnisotropicOffOrigin) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  DicomSpec spec = oneFrame();
  spec.row = turn.col(0);
  spec.column = turn.col(1);
  spec.step = -2 * turn.col(2);  // the file goes against the normal
  spec.origin = {-103.3, 57.7, 1000.0 / 7};
  spec.frames.push_back({1, 1, kB});
  const Segmentation s = read(spec);
  EXPECT_EQ(slice(s, 0, 1), times(kA, 1));
  EXPECT_EQ(slice(s, 0, 0), times(kB, 1));
  const Eigen::Vector3d corner = spec.origin + 3 * 0.5 * spec.row + 2 * 0.7 * spec.column;
  // Numbers in DICOM have 10 digits here.
  EXPECT_LT((s.geometry.indexToPhysical() * Eigen::Vector3d(3, 2, 1) - corner).norm(), 1e-6);
  EXPECT_NEAR(s.geometry.direction.determinant(), 1, 1e-8);
}

TEST(DicomSegmentation, TiltedGantryShears) {
  DicomSpec spec = oneFrame();
  spec.step = {0, 0.6, 2};
  spec.frames.push_back({1, 1, kB});
  const Segmentation s = read(spec);
  EXPECT_LT((s.geometry.indexToPhysical() * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(10, 20.6, 32)).norm(),
            1e-9);
}

TEST(DicomSegmentation, OverlappingSegmentsComeToLayers) {
  DicomSpec spec;
  spec.segments = {{.number = 1, .label = "a"}, {.number = 2, .label = "c"}, {.number = 3, .label = "b"}};
  spec.frames = {{1, 0, kA}, {2, 0, kC}, {3, 0, kB}};
  const Segmentation s = read(spec);
  ASSERT_EQ(s.layers.size(), 2u);
  std::vector<std::int32_t> both = times(kA, 1);
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += 3 * kB[i];
  EXPECT_EQ(s.layers[0], both);
  EXPECT_EQ(s.layers[1], times(kC, 2));
  EXPECT_EQ(s.tissues[2].name, "c");
  EXPECT_EQ(s.tissues[2].layer, 1);
}

TEST(DicomSegmentation, FractionsAreRefusedOrThresholded) {
  DicomSpec spec{.type = "FRACTIONAL", .bits = 8};
  spec.frames = {{1, 0, {0, 1, 20, 99, 100, 101, 150, 199, 200, 0, 0, 0}}};  // of 200
  EXPECT_NE(test::messageOf<std::runtime_error>([&] { read(spec); }).find("is a FRACTIONAL segmentation"),
            std::string::npos);
  const auto from = [&](double share) { return read(spec, {.fractionalThreshold = share}).layers[0]; };
  EXPECT_EQ(from(0.5), (std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(from(1), (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(from(1e-6), (std::vector<std::int32_t>{0, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0}));
  for (const double share : {0.0, -1.0, 1.01, std::nan("")}) EXPECT_THROW(from(share), std::invalid_argument);
}

TEST(DicomSegmentation, LabelMaps) {
  for (const int bits : {8, 16}) {
    DicomSpec spec = labelMap(bits);
    if (bits == 16) {
      spec.segments[2].number = 700;
      spec.frames[0].pixels = times(kA, 700);
    }
    const Segmentation s = read(spec);
    ASSERT_EQ(s.layers.size(), 1u);
    EXPECT_EQ(slice(s, 0, 0), times(kA, bits == 16 ? 700 : 7));
    EXPECT_EQ(slice(s, 0, 1), times(kB, 1));
    ASSERT_EQ(s.tissues.size(), 2u);
    EXPECT_EQ(s.tissues[1].name, "fat");
    EXPECT_TRUE(s.emptyTissues.empty());
  }
}

TEST(DicomSegmentation, ALabelMapsPaddingIsItsBackground) {
  DicomSpec spec = labelMap(8);
  spec.frames = {{0, 0, {9, 9, 9, 0, 0, 1, 1, 7, 9, 9, 9, 9}}};
  spec.change = [](DcmDataset& dataset) { test::put(dataset, DCM_PixelPaddingValue, 9); };
  const Segmentation s = read(spec);
  EXPECT_EQ(s.layers[0], (std::vector<std::int32_t>{0, 0, 0, 8, 8, 1, 1, 7, 0, 0, 0, 0}));
  EXPECT_EQ(s.tissues[2].name, "background") << "segment 0, which has a label of its own now";
}

TEST(DicomSegmentation, PackedFiles) {
  DicomSpec deflated = oneFrame();
  deflated.syntax = EXS_DeflatedLittleEndianExplicit;
  EXPECT_EQ(read(deflated).layers[0], times(kA, 1));
  DicomSpec implicit = oneFrame();
  implicit.syntax = EXS_LittleEndianImplicit;
  EXPECT_EQ(read(implicit).layers[0], times(kA, 1));
  DicomSpec bigEndian = oneFrame();
  bigEndian.syntax = EXS_BigEndianExplicit;
  EXPECT_EQ(read(bigEndian).layers[0], times(kA, 1));
  for (const int bits : {8, 16}) {
    DicomSpec runs = labelMap(bits);
    runs.syntax = EXS_RLELossless;
    EXPECT_EQ(slice(read(runs), 0, 0), times(kA, 7)) << bits;
    EXPECT_EQ(slice(read(runs), 0, 1), times(kB, 1)) << bits;
  }
}

TEST(DicomSegmentation, SegmentsThatNobodyDescribesAreSaid) {
  DicomSpec spec = oneFrame();
  spec.frames[0].segment = 5;
  const Segmentation s = read(spec);
  EXPECT_EQ(s.tissues[0].name, "Segment_5");
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_NE(s.warnings[0].find("1 segments are painted but not described, first number 5"),
            std::string::npos);
}

// ---- real files, where they are at hand: dcmqi's, with the voxels that it reads from them

class ReadRealDicom : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("SINEW_TEST_DATA");
    if (!folder) GTEST_SKIP() << "SINEW_TEST_DATA names no folder with scans";
    folder_ = std::filesystem::path(folder) / "dcmqi-seg";
  }

  /// Each of dcmqi's files holds a layer.
  void expectLayers(const std::string& dicom, const std::vector<std::string>& layers) const {
    SCOPED_TRACE(dicom);
    const Segmentation s = readSegmentation(folder_ / dicom);
    ASSERT_EQ(s.layers.size(), layers.size());
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      const Segmentation expected = readSegmentation(folder_ / layers[layer]);
      EXPECT_EQ(s.layers[layer], expected.layers[0]) << layers[layer];
      EXPECT_LT((s.geometry.indexToPhysical().matrix() - expected.geometry.indexToPhysical().matrix()).norm(),
                1e-4);
    }
  }

  std::filesystem::path folder_;
};

TEST_F(ReadRealDicom, VoxelsAreThoseOfDcmqi) {
  expectLayers("liver.dcm", {"liver_seg.nrrd"});
  expectLayers("partial_overlaps.dcm",
               {"partial_overlaps-1.nrrd", "partial_overlaps-2.nrrd", "partial_overlaps-3.nrrd"});
  expectLayers("sparse-labelmap-noppv.dcm", {"sparse_labelmap_noppv_seg.nrrd"});
}

TEST_F(ReadRealDicom, NamesAndCodes) {
  const Segmentation s = readSegmentation(folder_ / "seg.dcm");
  ASSERT_EQ(s.tissues.size(), 1u);
  EXPECT_EQ(s.tissues[0].name, "Neoplasm, Primary");
  EXPECT_EQ(s.tissues[0].voxels, 795);
  EXPECT_NE(s.tissues[0].tags.at("TerminologyEntry").find("SRT^T-C5300^pharyngeal tonsil (adenoid)"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew
