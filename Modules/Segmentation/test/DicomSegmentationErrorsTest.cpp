#include "DicomBuilder.h"
#include "TestImages.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>

#include <ctime>

/// DICOM segmentations that are refused.
namespace sinew {
namespace {

using test::DicomFrameSpec;
using test::DicomSpec;
using test::kA;
using test::kB;
using test::labelMap;
using test::oneFrame;

std::string errorOf(const DicomSpec& spec) {
  return test::messageOf<std::runtime_error>([&] {
    const test::TempFolder folder;
    test::writeDicom(folder / "a.dcm", spec);
    readSegmentation(folder / "a.dcm");
  });
}

struct BadDicom {
  const char* what;
  DicomSpec spec;
  const char* expected;  ///< a part of the message
};

DicomSpec changed(std::function<void(DcmDataset&)> change) {
  DicomSpec spec = oneFrame();
  spec.change = std::move(change);
  return spec;
}

DicomSpec withFrames(std::vector<DicomFrameSpec> frames) {
  DicomSpec spec;
  spec.frames = std::move(frames);
  return spec;
}

std::vector<BadDicom> badDicoms() {
  DicomSpec image = oneFrame();
  image.sopClass = UID_CTImageStorage;
  DicomSpec wideBits = labelMap(8);
  wideBits.bits = 1;
  DicomSpec far = withFrames({{1, 0, kA}, {1, 1, kB}, {1, 50'000'000, kA}});
  DicomSpec singular = oneFrame();
  singular.column = singular.row;
  DicomSpec nowhere = oneFrame();
  nowhere.pixelSpacing = {0, 1};
  return {
      {"an image", image, "is a DICOM object of another kind (CTImageStorage)"},
      {"no kind", changed([](DcmDataset& d) { d.findAndDeleteElement(DCM_SegmentationType); }),
       "SegmentationType is ``"},
      {"surface", changed([](DcmDataset& d) { test::put(d, DCM_SegmentationType, "SURFACE"); }),
       "is `SURFACE`"},
      {"bits", wideBits, "its pixels have 1 bits"},
      {"no rows", changed([](DcmDataset& d) { test::put(d, DCM_Rows, 0); }), "no rows or no columns"},
      {"more rows", changed([](DcmDataset& d) { test::put(d, DCM_Rows, 60000); }),
       "its pixels are truncated"},
      {"more pixels", changed([](DcmDataset& d) {
         test::put(d, DCM_Rows, 65535);
         test::put(d, DCM_Columns, 65535);
       }),
       "its pixels are truncated"},
      {"more frames", changed([](DcmDataset& d) { test::put(d, DCM_NumberOfFrames, "2000000000"); }),
       "it promises `2000000000` frames and describes 1"},
      {"no frames",
       changed([](DcmDataset& d) { d.findAndDeleteElement(DCM_PerFrameFunctionalGroupsSequence); }),
       "frames and describes 0"},
      {"no pixels", changed([](DcmDataset& d) { d.findAndDeleteElement(DCM_PixelData); }),
       "its pixels are truncated"},
      {"no place", changed([](DcmDataset& d) { d.findAndDeleteElement(DCM_SharedFunctionalGroupsSequence); }),
       "frame 1 has no ImageOrientationPatient"},
      {"no segment", withFrames({{0, 0, kA}}), "frame 1 does not say which segment"},
      {"far apart", far, "frames lie"},
      {"singular", singular, "axis directions are singular"},
      {"no spacing", nowhere, "the voxel spacing along axis 1 is 0"},
  };
}

TEST(DicomSegmentationErrors, BadFilesEndInOneLineWithinASecond) {
  for (const BadDicom& bad : badDicoms()) {
    SCOPED_TRACE(bad.what);
    const std::clock_t start = std::clock();
    const std::string message = errorOf(bad.spec);
    EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC);
    EXPECT_NE(message.find(bad.expected), std::string::npos) << message;
    EXPECT_NE(message.find("a.dcm: "), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(DicomSegmentationErrors, UnevenSlicesAreRefused) {
  DicomSpec spec = oneFrame();
  spec.sliceSpacing = "";
  spec.step = {0, 0, 1};
  spec.frames = {{1, 0, kA}, {1, 2, kB}, {1, 5, kA}};  // gaps 2 and 3
  EXPECT_NE(errorOf(spec).find("its slices are not evenly spaced"), std::string::npos) << errorOf(spec);
}

/// Where the dataset begins: behind the group length and what it counts.
std::size_t datasetOf(const std::string& bytes) {
  constexpr std::size_t length = 140, behind = 144;
  return behind + static_cast<unsigned char>(bytes[length]) +
         256u * static_cast<unsigned char>(bytes[length + 1]);
}

std::string messageOfBytes(const std::string& bytes) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a.dcm", bytes);
  return test::messageOf<std::runtime_error>([&] { readSegmentation(folder / "a.dcm"); });
}

std::string bytesOf(const DicomSpec& spec) {
  const test::TempFolder folder;
  test::writeDicom(folder / "a.dcm", spec);
  return test::readBytes(folder / "a.dcm");
}

TEST(DicomSegmentationErrors, SequencesWithoutEndDoNotEndTheStack) {
  constexpr int deep = 200'000;  // here DCMTK 3.6.7 ends the program
  struct Row {
    E_TransferSyntax syntax;
    std::string level;  ///< a sequence and its first item
  };
  const std::string typed("\x08\x00\x15\x11SQ\0\0\xFF\xFF\xFF\xFF\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 20);
  const std::string untyped("\x08\x00\x15\x11\xFF\xFF\xFF\xFF\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 16);
  const std::string bigEndian("\x00\x08\x11\x15SQ\0\0\xFF\xFF\xFF\xFF\xFF\xFE\xE0\x00\xFF\xFF\xFF\xFF", 20);
  for (const Row& row :
       {Row{EXS_LittleEndianExplicit, typed}, Row{EXS_LittleEndianImplicit, untyped},
        Row{EXS_BigEndianExplicit, bigEndian}, Row{EXS_DeflatedLittleEndianExplicit, typed}}) {
    DicomSpec spec = oneFrame();
    spec.syntax = row.syntax;
    std::string bytes = bytesOf(spec), nested;
    for (int n = 0; n < deep; ++n) nested += row.level;
    if (row.syntax == EXS_DeflatedLittleEndianExplicit) nested = test::pack(nested, -15);
    bytes.insert(datasetOf(bytes), nested);
    EXPECT_NE(messageOfBytes(bytes).find("its sequences lie in one another without end"), std::string::npos)
        << row.syntax;
  }
}

TEST(DicomSegmentationErrors, CompressionsThatCannotBeUndoneAreNamed) {
  DicomSpec spec = labelMap(8);
  spec.syntax = EXS_RLELossless;
  std::string bytes = bytesOf(spec);
  const std::string runs(
      "UI\x14\x00"
      "1.2.840.10008.1.2.5\0",
      24),
      jpeg(
          "UI\x16\x00"
          "1.2.840.10008.1.2.4.90",
          26);
  const auto at = bytes.find(runs);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, runs.size(), jpeg);
  bytes[140] = static_cast<char>(bytes[140] + 2);  // the group's length
  EXPECT_NE(messageOfBytes(bytes).find("its pixels are compressed (JPEG 2000 (Lossless only))"),
            std::string::npos)
      << messageOfBytes(bytes);
}

TEST(DicomSegmentationErrors, TruncatedAnywhereItIsRefused) {
  const test::TempFolder folder;
  test::writeDicom(folder / "a.dcm", oneFrame());
  const std::string bytes = test::readBytes(folder / "a.dcm");
  for (std::size_t size = 132; size < bytes.size(); size += 7) {
    test::writeBytes(folder / "cut.dcm", bytes.substr(0, size));
    EXPECT_FALSE(test::messageOf<std::runtime_error>([&] { readSegmentation(folder / "cut.dcm"); }).empty())
        << size;
  }
}

}  // namespace
}  // namespace sinew
