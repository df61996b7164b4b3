#include "TestImages.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

/// NrrdIO leaks when it reports an error; the leak checker of the dev preset calls this.
extern "C" const char* __lsan_default_suppressions() { return "leak:libITKNrrdIO\n"; }

namespace sinew {
namespace {

using test::NiftiSpec;
using test::NrrdSpec;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string smallBytes() { return test::bytesOf(test::smallLabelsAs<std::int16_t>()); }

std::string without(std::string bytes, std::size_t fromEnd) {
  bytes.resize(bytes.size() - fromEnd);
  return bytes;
}

template <class Value>
std::string nrrdWith(const std::string& type, std::size_t voxel, Value value) {
  auto values = test::smallLabelsAs<Value>();
  values[voxel] = value;
  return test::nrrd({.type = type}, test::bytesOf(values));
}

std::string nrrdDirections(const std::string& directions) {
  return test::nrrd({.geometry = "space: left-posterior-superior\nspace directions: " + directions +
                                 "\nspace origin: (0,0,0)\n"},
                    smallBytes());
}

NrrdSpec multi(const std::string& kind, int components) {
  return {.dimension = "4",
          .sizes = std::to_string(components) + " 4 3 2",
          .geometry = "",
          .kinds = kind + " domain domain domain"};
}

std::string multiBytes(int components) {
  return test::bytesOf(std::vector<std::int16_t>(static_cast<std::size_t>(24 * components), 1));
}

NiftiSpec sformOnly(const test::Rows& rows) { return {.qformCode = 0, .sformCode = 1, .sform = rows}; }

struct BadFile {
  const char* what;
  const char* name;
  std::string bytes;
  const char* expected;  ///< a part of the message
};

std::string flippedAt(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  return bytes;
}

std::vector<BadFile> badFiles() {
  const std::string raw = smallBytes();
  std::string flipped = test::gzip(raw);
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0xFF);
  const std::string gzipNifti = test::gzip(test::nifti({}, raw));
  const std::string twoLayers = test::bytesOf(std::vector<std::int16_t>(48, 1));
  NrrdSpec outOfRange{.extra = "Segment0_ID:=a\nSegment0_Name:=bone\nSegment0_Layer:=3\n"};
  NrrdSpec secondWithoutLayer{.extra = "Segment0_ID:=a\nSegment1_ID:=b\n"};
  NrrdSpec background{.extra = "Segment0_ID:=a\nSegment0_LabelValue:=0\n"};
  NrrdSpec wordLabel{.extra = "Segment0_ID:=a\nSegment0_LabelValue:=one\n"};
  NrrdSpec timeSeries = multi("list", 2);
  timeSeries.extra = "MultiVolume.NumberOfFrames:=2\n";
  return {
      {"empty file", "a.nrrd", "", "is empty"},
      {"text", "a.nrrd", "hello\n", "is not an image"},
      {"text named NIfTI", "a.nii.gz", "hello\n", "is not an image"},
      {"picture", "a.png", "\x89PNG\r\n", "is not an image"},
      {"DICOM", "a.dcm", std::string(128, '\0') + "DICM", "DICOM"},

      {"NRRD header alone", "a.nrrd", "NRRD0004\n", "`dimension` and `sizes`"},
      {"NRRD raw truncated", "a.nrrd", without(test::nrrd({}, raw), 20), "truncated"},
      {"NRRD gzip truncated", "a.nrrd", without(test::nrrd({.encoding = "gzip"}, test::gzip(raw)), 20),
       "truncated"},
      {"NRRD gzip damaged", "a.nrrd", test::nrrd({.encoding = "gzip"}, flipped), "damaged"},
      {"NRRD sizes beyond memory", "a.nrrd", test::nrrd({.sizes = "400000 300000 2000"}, raw),
       "more than any memory"},
      {"NRRD sizes beyond the file", "a.nrrd",
       test::nrrd({.sizes = "4000 3000 2000", .encoding = "gzip"}, test::gzip(raw)), "truncated"},
      {"NRRD data file missing", "a.nhdr", test::nrrd({.extra = "data file: b.raw\n"}, ""),
       "`b.raw` is missing"},
      {"NRRD encoding unknown", "a.nrrd", test::nrrd({.encoding = "zip"}, raw), "header cannot be read"},
      {"NRRD block type", "a.nrrd", test::nrrd({.type = "block", .extra = "block size: 3\n"}, raw),
       "type is `block`"},
      {"NIfTI truncated", "a.nii", without(test::nifti({}, raw), 2), "truncated"},
      {"NIfTI gzip truncated", "a.nii.gz", without(gzipNifti, 20), "truncated"},
      {"NIfTI gzip without checksum", "a.nii.gz", without(gzipNifti, 4), "checksum"},
      {"NIfTI gzip with a wrong checksum", "a.nii.gz", flippedAt(gzipNifti, gzipNifti.size() - 8),
       "header cannot be read"},
      {"NIfTI gzip with a wrong length", "a.nii.gz", flippedAt(gzipNifti, gzipNifti.size() - 4),
       "header cannot be read"},
      {"NRRD gzip with a wrong checksum", "a.nrrd",
       test::nrrd({.encoding = "gzip"}, flippedAt(test::gzip(raw), test::gzip(raw).size() - 8)), "damaged"},
      {"MetaImage zlib with a wrong checksum", "a.mha",
       test::meta({.compressed = "True"}, flippedAt(test::zlib(raw), test::zlib(raw).size() - 1)), "damaged"},
      {"NIfTI header truncated", "a.nii", test::nifti({}, raw).substr(0, 300), "truncated"},
      {"NIfTI pair", "a.nii", test::nifti({.magic = std::string("ni1\0", 4)}, raw), ".hdr/.img pair"},
      {"NIfTI-2", "a.nii", std::string("\x1C\x02\0\0", 4) + std::string(600, '\0'), "NIfTI-2"},
      {"MetaImage truncated", "a.mha", without(test::meta({}, raw), 2), "truncated"},
      {"MetaImage zlib truncated", "a.mha", without(test::meta({.compressed = "True"}, test::zlib(raw)), 12),
       "truncated"},
      {"MetaImage data file missing", "a.mhd", test::meta({.dataFile = "b.zraw"}, ""), "`b.zraw` is missing"},
      {"MetaImage list of files", "a.mhd", test::meta({.dataFile = "LIST"}, ""), "many files"},

      // MetaIO also takes a colon for an equals sign, and the last of two fields.
      {"MetaImage of two dimensions", "a.mha", test::meta({.extra = "NDims := 1\n"}, raw), "is a 1-D image"},
      {"MetaImage of two sizes", "a.mha", test::meta({.type = "MET_SHORT\nDimSize: 4 3 9"}, raw),
       "its voxels take 216 or 48 bytes"},
      {"MetaImage of a huge second size", "a.mha",
       test::meta({.type = "MET_SHORT\nDimSize: 2000000000 2000000000 2000000000"}, raw),
       "more than any memory holds"},

      {"2-D NRRD", "a.nrrd", test::nrrd({.dimension = "2", .sizes = "4 6", .geometry = "", .kinds = ""}, raw),
       "2-D"},
      {"2-D NIfTI", "a.nii", test::nifti({.dim = {4, 6}}, raw), "2-D"},
      {"time series in NRRD", "a.nrrd",
       test::nrrd({.dimension = "4", .sizes = "2 3 2 2", .geometry = "", .kinds = ""}, raw), "time series"},
      {"time series as a list", "a.nrrd", test::nrrd(timeSeries, twoLayers), "time series"},
      {"time series in NIfTI", "a.nii", test::nifti({.dim = {2, 3, 2, 2}}, raw), "time series"},
      {"RGB NRRD", "a.nrrd", test::nrrd(multi("RGB-color", 3), multiBytes(3)), "colours"},
      {"RGB NIfTI", "a.nii", test::nifti({.datatype = 128, .bitpix = 24}, std::string(72, '\1')), "colours"},
      {"RGB MetaImage", "a.mha", test::meta({.extra = "ElementNumberOfChannels = 3\n"}, multiBytes(3)),
       "colours"},
      {"vectors in NRRD", "a.nrrd", test::nrrd(multi("3-vector", 3), multiBytes(3)), "vectors"},
      {"vectors in NIfTI", "a.nii", test::nifti({.dim = {4, 3, 2, 1, 3}, .intent = 1007}, multiBytes(3)),
       "vectors"},
      {"tensors in NRRD", "a.nrrd", test::nrrd(multi("3D-symmetric-matrix", 6), multiBytes(6)), "tensors"},
      {"tensors in NIfTI", "a.nii", test::nifti({.dim = {4, 3, 2, 1, 6}, .intent = 1005}, multiBytes(6)),
       "tensors"},
      {"complex NRRD", "a.nrrd", test::nrrd(multi("complex", 2), multiBytes(2)), "complex"},

      {"fraction", "a.nrrd", nrrdWith<float>("float", 17, 2.5f), "voxel (1, 1, 1) has the value 2.5;"},
      {"NaN", "a.nrrd", nrrdWith<double>("double", 5, std::nan("")), "voxel (1, 1, 0) has the value nan;"},
      {"infinity", "a.nrrd", nrrdWith<double>("double", 3, INFINITY), "voxel (3, 0, 0) has the value inf;"},
      {"beyond 32 bits", "a.nrrd", nrrdWith<std::uint64_t>("uint64", 0, std::uint64_t{1} << 63),
       "voxel (0, 0, 0) has the value 9223372036854775808;"},
      {"beyond signed 32 bits", "a.nrrd", nrrdWith<std::uint32_t>("unsigned int", 4, 4294967295u),
       "voxel (0, 1, 0) has the value 4294967295;"},
      {"below 32 bits", "a.nrrd", nrrdWith<std::int64_t>("int64", 23, -2147483649),
       "has the value -2147483649;"},
      {"fraction after scaling", "a.nii", test::nifti({.slope = 0.5f}, raw),
       "voxel (2, 0, 0) has the value 0.5;"},
      {"nothing but background", "a.nrrd", test::nrrd({}, std::string(48, '\0')), "no voxel other than 0"},
      {"one voxel", "a.nrrd", test::nrrd({.sizes = "1 1 1"}, std::string("\1\0", 2)), "single voxel"},

      {"NRRD zero spacing", "a.nrrd", test::nrrd({.geometry = "spacings: 1 0 1\n"}, raw),
       "along axis 1 is 0"},
      {"NRRD NaN spacing", "a.nrrd", test::nrrd({.geometry = "spacings: 1 1 nan\n"}, raw),
       "along axis 2 is nan"},
      {"NRRD zero direction", "a.nrrd", nrrdDirections("(0,0,0) (0,1,0) (0,0,1)"), "along axis 0 is 0"},
      {"NRRD NaN direction", "a.nrrd", nrrdDirections("(1,0,0) (0,nan,0) (0,0,1)"), "along axis 1 is nan"},
      {"NRRD singular directions", "a.nrrd", nrrdDirections("(1,0,0) (2,0,0) (0,0,1)"), "singular"},
      {"MetaImage zero spacing", "a.mha", test::meta({.spacing = "1 1 0"}, raw), "along axis 2 is 0"},
      {"MetaImage NaN spacing", "a.mha", test::meta({.spacing = "nan 1 1"}, raw), "along axis 0 is nan"},
      {"MetaImage singular directions", "a.mha", test::meta({.matrix = "1 0 0 1 0 0 0 0 1"}, raw),
       "singular"},
      {"NIfTI zero spacing", "a.nii", test::nifti({.pixdim = {1, 0, 1}}, raw), "along axis 1 is 0"},
      {"NIfTI NaN spacing", "a.nii", test::nifti({.pixdim = {kNan, 1, 1}}, raw), "along axis 0 is nan"},
      {"NIfTI NaN qform", "a.nii", test::nifti({.qform = {kNan, 0, 0, 0, 0, 0}}, raw), "qform"},
      {"NIfTI singular sform", "a.nii",
       test::nifti(sformOnly({{{1, 1, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}}}), raw), "singular"},
      {"NIfTI NaN sform", "a.nii",
       test::nifti(sformOnly({{{1, 0, 0, 0}, {0, kNan, 0, 0}, {0, 0, 1, 0}}}), raw),
       "singular or not numbers"},

      {"segment on no layer", "a.nrrd", test::nrrd(outOfRange, raw), "segment `bone` lies on layer 3"},
      {"segment without layer", "a.nrrd", test::nrrd(secondWithoutLayer, raw),
       "what a missing Segment1_Layer means"},
      {"segment of the background", "a.nrrd", test::nrrd(background, raw), "label value 0"},
      {"segment without a number", "a.nrrd", test::nrrd(wordLabel, raw), "Segment0_LabelValue is `one`"},
  };
}

std::string messageOfReading(const std::filesystem::path& file) {
  return test::messageOf<std::runtime_error>([&] { readSegmentation(file); });
}

TEST(ReadSegmentationErrors, OneLineThatNamesTheFileAndTheFault) {
  const test::TempFolder folder;
  for (const BadFile& bad : badFiles()) {
    SCOPED_TRACE(bad.what);
    const std::filesystem::path file = folder / bad.name;
    test::writeBytes(file, bad.bytes);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const std::string message = messageOfReading(file);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
    EXPECT_NE(message.find(bad.expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "does not say what to do: " << message;
    std::filesystem::remove(file);
  }
}

TEST(ReadSegmentationErrors, MissingFileAndFolder) {
  const test::TempFolder folder;
  EXPECT_NE(messageOfReading(folder / "missing.nrrd").find("missing.nrrd: there is no such file"),
            std::string::npos);
  EXPECT_NE(messageOfReading(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(messageOfReading("/dev/null").find("is not a regular file"), std::string::npos);
}

TEST(ReadSegmentationErrors, TheFileIsNamedAsTyped) {
  EXPECT_TRUE(messageOfReading("./no/../such.nrrd").starts_with("./no/../such.nrrd: "));
}

TEST(ReadSegmentationErrors, WrongColourTableIsFoundBeforeTheImageIsRead) {
  const test::TempFolder folder;
  const std::string message = test::messageOf<std::runtime_error>(
      [&] { readSegmentation(folder / "a.nrrd", {.lut = folder / "b.ctbl"}); });
  EXPECT_NE(message.find("b.ctbl: there is no such colour table"), std::string::npos) << message;
}

/// Every file cut at every byte, and every byte of every header changed: a result or one line, never a crash.
TEST(ReadSegmentationErrors, DamagedFilesNeverCrash) {
  const test::TempFolder folder;
  const std::string raw = smallBytes();
  const std::pair<const char*, std::string> files[]{
      {"a.nrrd",
       test::nrrd({.encoding = "gzip", .extra = "Segment0_ID:=a\nSegment0_Layer:=0\n"}, test::gzip(raw))},
      {"a.mha", test::meta({.compressed = "True"}, test::zlib(raw))},
      {"a.nii", test::nifti({.sformCode = 1, .sform = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 2, 0}}}}, raw)}};
  const auto tryBytes = [&](const char* name, const std::string& bytes) {
    const std::filesystem::path file = folder / name;
    test::writeBytes(file, bytes);
    const std::string message = messageOfReading(file);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.empty() || message.starts_with(file.string() + ": ")) << message;
  };
  for (const auto& [name, bytes] : files)
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      tryBytes(name, bytes.substr(0, i));
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ (1 + i % 255));
      tryBytes(name, changed);
    }
}

}  // namespace
}  // namespace sinew
