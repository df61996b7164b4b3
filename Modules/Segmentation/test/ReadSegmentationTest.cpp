#include "TestImages.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIOFactory.h>
#include <itkNiftiImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace sinew {
namespace {

using test::MetaSpec;
using test::NiftiSpec;
using test::NrrdSpec;

void expectSmallLabels(const Segmentation& s) {
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_EQ(s.geometry.size, Eigen::Vector3i(4, 3, 2));
  EXPECT_EQ(s.layers[0], test::smallLabels());
  ASSERT_EQ(s.tissues.size(), 3u);
  EXPECT_EQ(s.tissues[0].name, "Segment_1");
  EXPECT_EQ(s.tissues[2].label, 7);
  EXPECT_EQ(s.tissues[2].voxels, 3);
}

/// The small image in every format and packing that can hold the type.
template <class Value>
void expectReadsInEveryFormat(const std::string& nrrdType, const std::string& metaType,
                              std::int16_t niftiType) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<Value>());
  const std::int16_t bits = 8 * sizeof(Value);
  SCOPED_TRACE(nrrdType);
  expectSmallLabels(test::segmentationFrom("raw.nrrd", test::nrrd({.type = nrrdType}, raw)));
  expectSmallLabels(
      test::segmentationFrom("gz.nrrd", test::nrrd({.type = nrrdType, .encoding = "gzip"}, test::gzip(raw))));
  expectSmallLabels(test::segmentationFrom("raw.mha", test::meta({.type = metaType}, raw)));
  expectSmallLabels(
      test::segmentationFrom("z.mha", test::meta({.type = metaType, .compressed = "True"}, test::zlib(raw))));
  const NiftiSpec spec{.datatype = niftiType, .bitpix = bits};
  expectSmallLabels(test::segmentationFrom("raw.nii", test::nifti(spec, raw)));
  expectSmallLabels(test::segmentationFrom("gz.nii.gz", test::gzip(test::nifti(spec, raw))));
}

TEST(ReadSegmentation, AnImageIsToldByItsContentWhateverItsName) {
  const test::TempFolder folder;
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::uint8_t>());
  for (const std::string& bytes :
       {test::nrrd({.type = "unsigned char"}, raw), test::meta({.type = "MET_UCHAR"}, raw),
        test::nifti({.datatype = 2, .bitpix = 8}, raw),
        test::gzip(test::nifti({.datatype = 2, .bitpix = 8}, raw)),
        std::string(128, '\0') + "DICM" + std::string(100, '\0')}) {
    test::writeBytes(folder / "image.vtu", bytes);
    EXPECT_TRUE(isImageFile(folder / "image.vtu"));
  }
  for (const char* bytes : {"<VTKFile type=\"UnstructuredGrid\">", "$MeshFormat\n2.2 0 8\n", "# NRRD"}) {
    test::writeBytes(folder / "mesh.nrrd", bytes);
    EXPECT_FALSE(isImageFile(folder / "mesh.nrrd"));
  }
}

TEST(ReadSegmentation, EveryPixelTypeOfEveryFormat) {
  expectReadsInEveryFormat<std::uint8_t>("unsigned char", "MET_UCHAR", 2);
  expectReadsInEveryFormat<std::int8_t>("signed char", "MET_CHAR", 256);
  expectReadsInEveryFormat<std::uint16_t>("unsigned short", "MET_USHORT", 512);
  expectReadsInEveryFormat<std::int16_t>("short", "MET_SHORT", 4);
  expectReadsInEveryFormat<std::uint32_t>("unsigned int", "MET_UINT", 768);
  expectReadsInEveryFormat<std::int32_t>("int", "MET_INT", 8);
  expectReadsInEveryFormat<std::uint64_t>("uint64", "MET_ULONG_LONG", 1280);
  expectReadsInEveryFormat<std::int64_t>("longlong", "MET_LONG_LONG", 1024);
  expectReadsInEveryFormat<float>("float", "MET_FLOAT", 16);
  expectReadsInEveryFormat<double>("double", "MET_DOUBLE", 64);
}

TEST(ReadSegmentation, LabelsUpToBothEndsOf32Bits) {
  std::vector<std::int64_t> labels(24, 0);
  labels[3] = INT32_MAX;
  labels[4] = INT32_MIN;
  const Segmentation s =
      test::segmentationFrom("a.nrrd", test::nrrd({.type = "int64"}, test::bytesOf(labels)));
  EXPECT_EQ(s.layers[0][3], INT32_MAX);
  EXPECT_EQ(s.layers[0][4], INT32_MIN);
  EXPECT_EQ(s.tissues[0].name, "Segment_-2147483648");
}

TEST(ReadSegmentation, BigEndianFiles) {
  std::string swapped = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  for (std::size_t i = 0; i < swapped.size(); i += 2) std::swap(swapped[i], swapped[i + 1]);
  std::string big = test::meta({}, swapped);
  big.replace(big.find("MSB = False"), 11, "MSB = True");
  expectSmallLabels(test::segmentationFrom("big.mha", big));
  big = test::nrrd({}, swapped);
  big.replace(big.find("endian: little"), 14, "endian: big");
  expectSmallLabels(test::segmentationFrom("big.nrrd", big));
}

TEST(ReadSegmentation, NiftiScaleIsApplied) {
  std::vector<std::int16_t> halves(24, 2);
  halves[5] = 6;
  const NiftiSpec spec{.slope = 0.5f, .intercept = -1};  // 2 -> 0, 6 -> 2
  const Segmentation s = test::segmentationFrom("a.nii", test::nifti(spec, test::bytesOf(halves)));
  ASSERT_EQ(s.tissues.size(), 1u);
  EXPECT_EQ(s.tissues[0].label, 2);
  EXPECT_EQ(s.layers[0][5], 2);
}

TEST(ReadSegmentation, FourthAxisOfOneImageIsAVolume) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  expectSmallLabels(test::segmentationFrom("a.nii", test::nifti({.dim = {4, 3, 2, 1}}, raw)));
}

TEST(ReadSegmentation, DetachedDataFiles) {
  const test::TempFolder folder;
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  test::writeBytes(folder / "a.raw", raw);
  test::writeBytes(folder / "a.zraw", test::zlib(raw));
  test::writeBytes(folder / "a.raw.gz", test::gzip(raw));
  test::writeBytes(folder / "a.nhdr", test::nrrd({.extra = "data file: a.raw\n"}, ""));
  test::writeBytes(folder / "z.nhdr", test::nrrd({.encoding = "gzip", .extra = "data file: a.raw.gz\n"}, ""));
  test::writeBytes(folder / "a.mhd", test::meta({.dataFile = "a.raw"}, ""));
  // The size is wrong on purpose, as in real files: the data file itself tells where it ends.
  test::writeBytes(
      folder / "z.mhd",
      test::meta({.compressed = "True", .dataFile = "a.zraw", .extra = "CompressedDataSize = 9\n"}, ""));
  for (const char* name : {"a.nhdr", "z.nhdr", "a.mhd", "z.mhd"}) {
    SCOPED_TRACE(name);
    expectSmallLabels(readSegmentation(folder / name));
  }
}

// ---- geometry: ITK's own image reader is the oracle

ImageGeometry geometryOfItk(const std::filesystem::path& file) {
  itk::NrrdImageIOFactory::RegisterOneFactory();
  itk::NiftiImageIOFactory::RegisterOneFactory();
  itk::MetaImageIOFactory::RegisterOneFactory();
  const auto image = itk::ReadImage<itk::Image<float, 3>>(file.string());
  ImageGeometry geometry;
  for (int i = 0; i < 3; ++i) {
    geometry.size[i] = static_cast<int>(image->GetLargestPossibleRegion().GetSize(i));
    geometry.spacing[i] = image->GetSpacing()[i];
    geometry.origin[i] = image->GetOrigin()[i];
    for (int j = 0; j < 3; ++j) geometry.direction(i, j) = image->GetDirection()(i, j);
  }
  return geometry;
}

void expectGeometryOfItk(const std::string& name, const std::string& bytes) {
  const test::TempFolder folder;
  test::writeBytes(folder / name, bytes);
  const ImageGeometry ours = readSegmentation(folder / name).geometry, itks = geometryOfItk(folder / name);
  EXPECT_EQ(ours.size, itks.size);
  EXPECT_EQ(ours.spacing, itks.spacing);
  EXPECT_EQ(ours.origin, itks.origin);
  EXPECT_EQ(ours.direction, itks.direction) << ours.direction << "\n\n" << itks.direction;
}

NrrdSpec nrrdIn(const std::string& space, const std::string& directions) {
  return {.geometry =
              "space: " + space + "\nspace directions: " + directions + "\nspace origin: (-70.5,20,3e1)\n"};
}

TEST(ReadSegmentation, GeometryIsItksForNrrd) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  for (const char* directions : {"(0.3,0,0) (0,0.4,0) (0,0,2)", "(0,0,-0.3) (0.4,0,0) (0,-2,0)",
                                 "(0.36,0.48,0) (-0.8,0.6,0) (0,0,-2)", "(1,0,0) (0,1,0) (0,0.2,2)"})
    for (const char* space : {"left-posterior-superior", "RAS", "left-anterior-superior"}) {
      SCOPED_TRACE(std::string(space) + " " + directions);
      expectGeometryOfItk("a.nrrd", test::nrrd(nrrdIn(space, directions), raw));
    }
  expectGeometryOfItk("spacings.nrrd", test::nrrd({.geometry = "spacings: 0.5 -2 3\n"}, raw));
}

TEST(ReadSegmentation, GeometryIsItksForMetaImage) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  expectGeometryOfItk("a.mha", test::meta({.matrix = "0.6 0.8 0 -0.8 0.6 0 0 0 -1"}, raw));
  expectGeometryOfItk("a.mha", test::meta({.matrix = "0 0 1 1 0 0 0 1 0"}, raw));
  expectGeometryOfItk("a.mha", test::meta({.spacing = "-1 1 2"}, raw));
  expectGeometryOfItk("shear.mha", test::meta({.matrix = "1 0 0 0 1 0 0 0.1 1"}, raw));
}

TEST(ReadSegmentation, GeometryIsItksForNifti) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  expectGeometryOfItk("q.nii", test::nifti({.qform = {0.3f, 0.2f, -0.1f, 5, 6, 7}}, raw));
  const test::Rows straight{{{-1, 0, 0, 5}, {0, 0, 2, 6}, {0, 1, 0, 7}}};
  expectGeometryOfItk(
      "s.nii", test::nifti({.pixdim = {1, 1, 2}, .qformCode = 0, .sformCode = 1, .sform = straight}, raw));
  expectGeometryOfItk("qs.nii", test::nifti({.sformCode = 2, .sform = straight}, raw));
  expectGeometryOfItk("none.nii", test::nifti({.qformCode = 0}, raw));
}

TEST(ReadSegmentation, NiftiSformThatItkRefusesIsTakenAsItStands) {
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  const test::Rows sheared{{{3, 0, 0.5f, 5}, {0, 3, 0, 6}, {0, 0, 2, 7}}};
  const Segmentation s =
      test::segmentationFrom("s.nii", test::nifti({.qformCode = 0, .sformCode = 1, .sform = sheared}, raw));
  Eigen::Matrix4d lps = Eigen::Matrix4d::Identity();
  lps.topRows(3) << -3, 0, -0.5, -5, 0, -3, 0, -6, 0, 0, 2, 7;
  // Splitting a column into length and direction and back costs a rounding.
  EXPECT_LT((s.geometry.indexToPhysical().matrix() - lps).norm(), 1e-14);
}

// ---- Slicer's segmentations

std::string segment(int n, const std::string& name, int label, int layer,
                    const std::string& color = "1 0.5 0", const std::string& tags = "") {
  const std::string prefix = "Segment" + std::to_string(n) + "_";
  return prefix + "ID:=Segment_" + std::to_string(n + 1) + "\n" + prefix + "Name:=" + name + "\n" + prefix +
         "NameAutoGenerated:=0\n" + prefix + "Color:=" + color + "\n" + prefix + "ColorAutoGenerated:=0\n" +
         prefix + "LabelValue:=" + std::to_string(label) + "\n" + prefix + "Layer:=" + std::to_string(layer) +
         "\n" + prefix + "Extent:=0 3 0 2 0 1\n" + prefix + "Tags:=" + tags + "\n";
}

constexpr const char* kFileKeys =
    "Segmentation_MasterRepresentation:=Binary labelmap\nSegmentation_ContainedRepresentationNames:=Binary "
    "labelmap|\nSegmentation_ReferenceImageExtentOffset:=5 6 7\nSegmentation_ConversionParameters:=a|1|b&\n";

std::string slicerFile(const std::string& segments, NrrdSpec spec = {}) {
  spec.extra = kFileKeys + segments;
  return test::nrrd(spec, test::bytesOf(test::smallLabelsAs<std::int16_t>()));
}

TEST(ReadSegmentation, SlicerSegmentsEqualTheHeader) {
  const std::string segments =
      segment(0, "left kidney", 7, 0, "0.25 0.5 1", "a:b|TerminologyEntry:x~SCT^1^y:z|") +
      segment(1,
              "Sch\xC3\xA4"
              "del\\\\\\n2",
              1, 0) +
      segment(2, "nothing there", 99, 0);
  for (const char* name : {"a.seg.nrrd", "renamed.nrrd", "temp.dat"}) {
    SCOPED_TRACE(name);
    const Segmentation s = test::segmentationFrom(name, slicerFile(segments));
    ASSERT_EQ(s.tissues.size(), 3u);
    EXPECT_EQ(s.tissues[0].name,
              "Sch\xC3\xA4"
              "del\\\n2");
    EXPECT_EQ(s.tissues[0].id, "Segment_2");
    EXPECT_EQ(s.tissues[1].name, "Segment_2");  // value 2 has no segment
    EXPECT_FALSE(s.tissues[1].named);
    const Tissue& kidney = s.tissues[2];
    EXPECT_EQ(kidney.name, "left kidney");
    EXPECT_TRUE(kidney.named);
    EXPECT_EQ(kidney.label, 7);
    EXPECT_EQ(kidney.color, (std::array<double, 3>{0.25, 0.5, 1}));
    EXPECT_EQ(kidney.tags,
              (std::map<std::string, std::string>{{"a", "b"}, {"TerminologyEntry", "x~SCT^1^y:z"}}));
    ASSERT_EQ(s.emptyTissues.size(), 1u);
    EXPECT_EQ(s.emptyTissues[0].name, "nothing there");
    EXPECT_EQ(s.keys.at("Segmentation_ConversionParameters"), "a|1|b&");
  }
}

/// Layer l of voxel v: l + 1 where v is divisible by l + 1, except that layers 0 and 1 both use the value 1.
std::int16_t layeredValue(int layer, int voxel) {
  if (voxel % (layer + 1) != 0) return 0;
  return static_cast<std::int16_t>(layer <= 1 ? 1 : layer + 1);
}

std::vector<std::int16_t> layeredVoxels(int layers) {
  std::vector<std::int16_t> values;
  for (int voxel = 0; voxel < 24; ++voxel)
    for (int layer = 0; layer < layers; ++layer) values.push_back(layeredValue(layer, voxel));
  return values;
}

NrrdSpec layeredSpec(int layers, const std::string& kind) {
  return {.dimension = "4",
          .sizes = std::to_string(layers) + " 4 3 2",
          .geometry =
              "space: left-posterior-superior\nspace directions: none (1,0,0) (0,1,0) (0,0,2)\n"
              "space origin: (10,20,30)\n",
          .kinds = kind + " domain domain domain"};
}

TEST(ReadSegmentation, LayersNeverMixWhateverTheirNumber) {
  for (const int layers : {2, 3, 4, 5}) {
    SCOPED_TRACE(layers);
    NrrdSpec spec = layeredSpec(layers, "list");
    for (int n = 0; n < layers; ++n)
      spec.extra += segment(n, "on layer " + std::to_string(n), layeredValue(n, 0), n);
    const Segmentation s =
        test::segmentationFrom("a.seg.nrrd", test::nrrd(spec, test::bytesOf(layeredVoxels(layers))));
    ASSERT_EQ(s.layers.size(), static_cast<std::size_t>(layers));
    ASSERT_EQ(s.tissues.size(), static_cast<std::size_t>(layers));
    for (int layer = 0; layer < layers; ++layer) {
      for (int voxel = 0; voxel < 24; ++voxel) EXPECT_EQ(s.layers[layer][voxel], layeredValue(layer, voxel));
      EXPECT_EQ(s.tissues[layer].name, "on layer " + std::to_string(layer));
      EXPECT_EQ(s.tissues[layer].voxels, 24 / (layer + 1) + (24 % (layer + 1) != 0));
    }
    EXPECT_EQ(s.geometry.origin, Eigen::Vector3d(10, 20, 30));
    EXPECT_EQ(s.geometry.spacing, Eigen::Vector3d(1, 1, 2));
  }
}

TEST(ReadSegmentation, SlicerLayersMayBeOfVectorKind) {
  NrrdSpec spec = layeredSpec(2, "vector");
  spec.extra = segment(0, "a", 1, 0) + segment(1, "b", 1, 1);
  EXPECT_EQ(
      test::segmentationFrom("a.nrrd", test::nrrd(spec, test::bytesOf(layeredVoxels(2)))).tissues[1].name,
      "b");
}

TEST(ReadSegmentation, ListWithoutSegmentsHasUnnamedLayers) {
  const Segmentation s =
      test::segmentationFrom("a.nrrd", test::nrrd(layeredSpec(2, "list"), test::bytesOf(layeredVoxels(2))));
  ASSERT_EQ(s.tissues.size(), 2u);
  EXPECT_EQ(s.tissues[1].name, "Segment_1_layer_1");
}

// ---- colour tables

TEST(ReadSegmentation, LutNamesAndColoursAndOverrides) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a.seg.nrrd", slicerFile(segment(0, "from the file", 1, 0)));
  test::writeBytes(folder / "a.ctbl",
                   "# Color table file\n1 left_bone 0 255 0 255\n2 _ 255 0 0 255\n50 absent 0 0 0 255\n");
  const Segmentation s = readSegmentation(folder / "a.seg.nrrd", {.lut = folder / "a.ctbl"});
  ASSERT_EQ(s.tissues.size(), 3u);
  EXPECT_EQ(s.tissues[0].name, "left bone");
  EXPECT_EQ(s.tissues[0].id, "Segment_1");
  EXPECT_EQ(s.tissues[0].color, (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(s.tissues[1].name, "Segment_2");  // an empty name in the table
  EXPECT_EQ(s.tissues[1].color, (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(s.tissues[2].name, "Segment_7");
  EXPECT_TRUE(s.emptyTissues.empty());
}

// ---- real scans, where they are at hand

class ReadRealScans : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("SINEW_TEST_DATA");
    if (!folder) GTEST_SKIP() << "SINEW_TEST_DATA names no folder with scans";
    folder_ = folder;
  }
  std::filesystem::path folder_;
};

TEST_F(ReadRealScans, KneeAtlas) {
  const Segmentation s =
      readSegmentation(folder_ / "spl-knee/seg.nrrd", {.lut = folder_ / "spl-knee/knee.ctbl"});
  EXPECT_EQ(s.tissues.size(), 49u);
  EXPECT_EQ(std::ranges::count_if(s.tissues, &Tissue::named), 48);
  const auto femur = std::ranges::find(s.tissues, "femur", &Tissue::name);
  ASSERT_NE(femur, s.tissues.end());
  EXPECT_EQ(femur->label, 95);
}

TEST_F(ReadRealScans, ObliqueFloatNiftiWithoutQform) {
  const Segmentation s = readSegmentation(folder_ / "verse004/sub-verse004_seg-vert_msk.nii.gz");
  ASSERT_EQ(s.tissues.size(), 9u);
  EXPECT_EQ(s.tissues.front().label, 16);
  EXPECT_EQ(s.tissues.back().label, 24);
}

TEST_F(ReadRealScans, OverlappingSegmentsOfSlicer) {
  const Segmentation s = readSegmentation(folder_ / "slicerio/SegmentationOverlapping.seg.nrrd");
  EXPECT_EQ(s.layers.size(), 2u);
  EXPECT_EQ(s.tissues.size(), 8u);
}

/// A gzip member whose header carries a file name of `length` letters.
std::string namedMember(const std::string& bytes, std::size_t length) {
  std::string member = test::gzip(bytes);
  member[3] = 8;  // FNAME
  member.insert(10, std::string(length, 'n') + '\0');
  return member;
}

TEST(ReadSegmentation, GzipMembersFollowEachOtherWhereverTheirHeadersFall) {
  const test::TempFolder folder;
  const std::string raw = test::bytesOf(test::smallLabelsAs<std::int16_t>());
  std::string packed;
  for (std::size_t i = 0; i < raw.size(); ++i)  // one byte each; headers of all lengths around 64 KB in all
    packed += namedMember(raw.substr(i, 1), 6000 + 997 * i % 1000);
  packed += "what follows is of no concern";
  test::writeBytes(folder / "a.nrrd", test::nrrd({.encoding = "gzip"}, packed));
  EXPECT_EQ(readSegmentation(folder / "a.nrrd").layers[0], test::smallLabels());
}

}  // namespace
}  // namespace sinew
