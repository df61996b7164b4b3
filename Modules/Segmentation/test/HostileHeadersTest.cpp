#include "TestImages.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>

#include <ctime>

/// Headers that promise what nobody has.
namespace sinew {
namespace {

using test::NrrdSpec;

/// The small image with more lines in its header.
std::string with(const std::string& lines) {
  return test::nrrd({.extra = lines}, test::bytesOf(test::smallLabelsAs<std::int16_t>()));
}

struct Hostile {
  const char* what;
  std::string bytes;
  const char* expected;  ///< a part of the message
};

std::vector<Hostile> hostileHeaders() {
  const NrrdSpec layers{.type = "unsigned char",
                        .dimension = "4",
                        .sizes = "1000000000 4 3 2",
                        .geometry = "",
                        .kinds = "list domain domain domain",
                        .encoding = "gzip"};
  std::string many;
  for (int n = 0; n < 100'000; ++n) many.append("Segment").append(std::to_string(n)).append("_ID:=s\n");
  const std::string one = "Segment0_ID:=a\n";
  return {
      {"10^9 layers", test::nrrd(layers, test::gzip("123456789012345678901234")), "truncated"},
      {"10^5 segments", with(many), "more than 30000 key/value pairs"},
      {"a layer beyond 32 bits", with("Segment0_Layer:=99999999999\n" + one), "which is no whole number"},
      {"a negative layer", with("Segment0_Layer:=-1\n" + one), "lies on layer -1"},
      {"a label that is the background", with("Segment0_LabelValue:=0\n" + one), "label value 0"},
      {"sizes that overflow", test::nrrd({.sizes = "4294967296 4294967296 4294967296"}, ""),
       "more than any memory"},
      {"a negative size", test::nrrd({.sizes = "-4 3 2"}, ""), "every axis needs at least one voxel"},
      {"NIfTI of 32767 cubed", test::nifti({.dim = {32767, 32767, 32767}}, ""), "more than any memory"},
      {"MetaImage of 10^27", test::meta({.sizes = "1000000000 1000000000 1000000000"}, ""),
       "more than any memory"},
      {"a gzip header of NIfTI alone", test::gzip(test::nifti({.dim = {30000, 30000, 300}}, "")),
       "header cannot be read"},
  };
}

TEST(HostileHeaders, EndInOneLineWithinASecond) {
  for (const Hostile& hostile : hostileHeaders()) {
    SCOPED_TRACE(hostile.what);
    const test::TempFolder folder;
    test::writeBytes(folder / "a.nii", hostile.bytes);
    const std::clock_t start = std::clock();
    const std::string message =
        test::messageOf<std::runtime_error>([&] { readSegmentation(folder / "a.nii"); });
    EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC);
    EXPECT_NE(message.find(hostile.expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(HostileHeaders, IndicesOfSegmentsMayBeAnything) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a.nrrd", with("Segment0_ID:=a\nSegment1000000000_ID:=b\n"
                                           "Segment99999999999999999999_ID:=c\nSegment-1_ID:=d\n"));
  const Segmentation s = readSegmentation(folder / "a.nrrd");
  EXPECT_EQ(s.tissues[0].id, "a");
  EXPECT_EQ(s.tissues.size(), 3u) << "1, and the unnamed 2 and 7";
}

}  // namespace
}  // namespace sinew
