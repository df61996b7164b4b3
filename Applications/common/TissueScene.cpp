#include "TissueScene.h"

#include "sinew/MeshIO/SlicerScene.h"
#include "sinew/Pipeline/OutputFile.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace sinew {
namespace {

/// What vtkMRMLModelStorageNode reads, of the formats that writeMesh knows.
constexpr std::array<std::string_view, 6> kSlicerFormats{".vtu", ".vtk", ".vtp", ".stl", ".ply", ".obj"};

}  // namespace

bool hasScene(const MeshTissuesOptions& options) {
  return std::ranges::count(kSlicerFormats, options.extension) > 0 && options.writing.perMm == 1;
}

void writeTissueScene(const std::vector<TissueReport>& tissues, const std::filesystem::path& file,
                      const WriteMeshOptions& writing) {
  SlicerScene scene;
  scene.space = writing.space;
  for (const TissueReport& tissue : tissues)
    if (!tissue.file.empty()) scene.models.push_back({tissue.file, tissue.name, tissue.color});
  OutputFile output(file);
  writeSlicerScene(scene, output.temporary());
  output.commit();
}

}  // namespace sinew
