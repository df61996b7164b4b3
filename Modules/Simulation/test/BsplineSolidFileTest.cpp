#include "sinew/Simulation/BsplineSolidFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::TempFolder;

const std::string kBox =
    "[[0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0], [0, 0, 30], [1, 0, 30], [0, 2, 30], [1, 2, 30]]";

TEST(BsplineSolidFile, HoldsControlPointsWithUTheFastest) {
  const TempFolder folder;
  test::writeBytes(folder / "a.json", R"({"counts": [2, 2, 2], "points": )" + kBox + "}");
  const BsplineSolid solid = readBsplineSolid(folder / "a.json");
  EXPECT_LT((solid.at({0.5, 0.25, 0.1}).x - Vector3d(0.5, 0.5, 3)).norm(), 1e-12);
  EXPECT_LT((solid.fibre({0.3, 1, 12}) - Vector3d::UnitZ()).norm(), 1e-12);

  test::writeBytes(folder / "b.json", R"({"space": "RAS", "counts": [2, 2, 2], "points": )" + kBox + "}");
  EXPECT_LT((readBsplineSolid(folder / "b.json").at({0.5, 0.25, 0.1}).x - Vector3d(-0.5, -0.5, 3)).norm(),
            1e-12);
}

TEST(BsplineSolidFile, ErrorsAreOneLineThatNamesTheFile) {
  const TempFolder folder;
  const std::filesystem::path file = folder / "a.json";
  const auto messageFor = [&](const std::string& text) {
    test::writeBytes(file, text);
    return test::messageOf<std::runtime_error>([&] { readBsplineSolid(file); });
  };
  const std::string flat = "[[0,0,0],[1,0,0],[0,2,0],[1,2,0],[0,0,0],[1,0,0],[0,2,0],[1,2,0]]";
  const std::pair<std::string, std::string> rows[]{
      {"{", "is no JSON"},
      {"[]", R"(holds no object {"counts": ..., "points": ...})"},
      {R"({"count": 3})", R"(unknown key "count"; known are "counts", "points" and "space")"},
      {R"({"points": []})", R"("counts" must be three whole numbers from 2 to 1000)"},
      {R"({"counts": [2, 2], "points": []})", R"("counts" must be three whole numbers from 2 to 1000)"},
      {R"({"counts": [2, 2, 2.5], "points": []})", R"("counts" must be three whole numbers from 2 to 1000)"},
      {R"({"counts": [2, 2, 1], "points": []})", R"("counts" must be three whole numbers from 2 to 1000)"},
      {R"({"counts": [2, 2, 2]})", R"("points" must be a list of [x, y, z])"},
      {R"({"counts": [2, 2, 2], "points": [[1, 2, 3], [1, 2]]})",
       "control point 1 is not [x, y, z] in numbers"},
      {R"({"counts": [2, 2, 2], "points": [[1, "2", 3]]})", "control point 0 is not [x, y, z] in numbers"},
      {R"({"counts": [2, 2, 2], "points": [[1, 2, 3]]})", "1 control points; the counts ask for 8"},
      {R"({"counts": [2, 2, 2], "space": "XYZ", "points": []})", R"("space" must be "LPS" or "RAS")"},
      {R"({"counts": [2, 2, 2], "points": )" + flat + "}",
       "the solid is folded or flat at u, v, w = 0.167, 0.167, 0.167"},
  };
  for (const auto& [text, what] : rows) EXPECT_EQ(messageFor(text), file.string() + ": " + what) << text;
  const std::filesystem::path none = folder / "none.json";
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { readBsplineSolid(none); }),
            none.string() + ": no such file, or not readable");
}

}  // namespace
}  // namespace sinew
