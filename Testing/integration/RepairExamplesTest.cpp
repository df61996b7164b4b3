#include "Program.h"
#include "sinew/Segmentation/LabelComponents.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sinew::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// One script of the folder Data with the phantom of its name.
struct Example {
  const char* name;
  double lost;       ///< what the phantom lacks (above 0) or has too much, mm^3
  double tolerance;  ///< of that
  const char* why;
};

class RepairExamples : public testing::TestWithParam<Example> {
 protected:
  RepairExamples() {
    const std::string name = GetParam().name;
    const std::string phantom = makePhantom(folder_, name).string();
    const std::string result = (folder_ / "repaired.seg.nrrd").string();
    const std::string script = std::string(SINEW_DATA) + "/" + name + ".lua";
    const ProgramResult repair = run({"repair", phantom, script, "-o", result, "--quiet"});
    EXPECT_EQ(repair.exitCode, 0) << repair.err;
    before_ = readSegmentation(phantom);
    after_ = readSegmentation(result);
  }
  static std::size_t piecesOf(const Segmentation& segmentation) {
    std::size_t pieces = 0;
    for (const Tissue& tissue : segmentation.tissues)
      pieces += labelComponents(segmentation, tissue).voxels.size();
    return pieces;
  }
  static double volumeOf(const Segmentation& segmentation) {
    double voxels = 0;
    for (const Tissue& tissue : segmentation.tissues) voxels += static_cast<double>(tissue.voxels);
    return voxels * segmentation.geometry.voxelVolume();
  }
  static std::int64_t sharedVoxels(const Segmentation& segmentation) {
    std::int64_t shared = 0;
    for (std::size_t n = 0; n < segmentation.layers.front().size(); ++n)
      shared += segmentation.layers.front()[n] != 0 && segmentation.layers.back()[n] != 0;
    return segmentation.layers.size() > 1 ? shared : 0;
  }

  TempFolder folder_;
  Segmentation before_, after_;
};

TEST_P(RepairExamples, GivesBackWhatWasLost) {
  const Example& example = GetParam();
  ASSERT_EQ(after_.tissues.size(), before_.tissues.size());
  for (std::size_t t = 0; t < after_.tissues.size(); ++t)
    EXPECT_EQ(after_.tissues[t].name, before_.tissues[t].name);
  EXPECT_EQ(piecesOf(after_), after_.tissues.size()) << "one piece each";
  EXPECT_EQ(sharedVoxels(after_), 0);
  EXPECT_NEAR(volumeOf(after_) - volumeOf(before_), example.lost, example.tolerance * std::abs(example.lost))
      << example.why;
}

INSTANTIATE_TEST_SUITE_P(
    Data, RepairExamples,
    testing::Values(
        Example{"drilled-femur", kPi * 6.25 * 23 * std::sqrt(1 + 0.0625), 0.2, "menisci at both mouths"},
        Example{"gapped-muscle", 3 * kPi * 14 * 9 * 0.9, 0.15, "and what the smoothing moved"},
        Example{"torn-vessel", 7 * kPi * 6.25 * 1.1, 0.15, "the fillets come on top"},
        Example{"speckled-liver", 4 * 32 - 6 * 56, 0.05, "voxels of the pinholes less those of the specks"},
        Example{"overlapping-muscles", -2022, 0.03, "the shared voxels, once"}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace sinew::test
