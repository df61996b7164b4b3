#include "sinew/MeshIO/MeshSeries.h"
#include "sinew/TestSupport/CommaLocale.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(MeshSeries, ListsTimesAndFiles) {
  const test::TempFolder folder;
  const test::CommaLocale commas;
  writeMeshSeries({{0, "a-000.vtu"}, {0.05, "<b>&\"c\".vtu"}}, folder / "a.pvd");
  EXPECT_EQ(test::readBytes(folder / "a.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
            "    <DataSet timestep=\"0\" file=\"a-000.vtu\" />\n"
            "    <DataSet timestep=\"0.05\" file=\"&lt;b>&amp;&quot;c&quot;.vtu\" />\n"
            "  </Collection>\n</VTKFile>\n");
}

TEST(MeshSeries, UnwritablePlacesAreNamed) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "none" / "a.pvd";
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { writeMeshSeries({}, file); }),
            file.string() + ": cannot be written");
}

}  // namespace
}  // namespace sinew
