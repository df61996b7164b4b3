#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/MeshPresets.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(MeshPresets, M8_EachProgramHasAFormatThatIsWritten) {
  for (const char* name : {"slicer", "paraview", "febio", "sofa", "abaqus", "fenics", "mfem"}) {
    const MeshPreset* preset = findMeshPreset(name);
    ASSERT_NE(preset, nullptr) << name;
    const MeshFormat* format = findMeshFormat("mesh" + std::string(preset->extension));
    ASSERT_NE(format, nullptr) << name;
    EXPECT_EQ(format->extension, preset->extension) << name;
    EXPECT_EQ(format->content, MeshContent::Volume) << name;
  }
  EXPECT_EQ(findMeshPreset("matlab"), nullptr);
}

TEST(MeshPresets, OnlySlicerAndParaViewGetTextThatOthersRefuse) {
  for (const MeshPreset& preset : meshPresets())
    EXPECT_EQ(preset.options.spaceTag, preset.name == "slicer" || preset.name == "paraview") << preset.name;
  EXPECT_TRUE(findMeshPreset("mfem")->options.material);
}

}  // namespace
}  // namespace sinew
