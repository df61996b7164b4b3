#include "VtuFormat.h"

#include "MeshFormatTable.h"

namespace sinew {

void writeVtuFormat(const TissueMesh& mesh, const std::filesystem::path& file,
                    const WriteMeshOptions& options) {
  TetMesh turned = mesh.mesh;
  for (Eigen::Vector3d& node : turned.nodes) node = inFile(node, options);
  writeVtu(turned, file, mesh.arrays);
}

TissueMesh readVtuFormat(const std::filesystem::path& file) { return {readTetMesh(file), {}, {}}; }

}  // namespace sinew
