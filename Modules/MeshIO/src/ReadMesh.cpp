#include "sinew/MeshIO/ReadMesh.h"

#include "FileFailure.h"
#include "MeshFormatTable.h"
#include "sinew/Mesher/MeshConditions.h"

#include <new>

namespace sinew {
namespace {

std::vector<NodeKind> kindsOf(const TetMesh& mesh) {
  std::vector<NodeKind> kinds(mesh.nodes.size(), NodeKind::Interior);
  for (const Triangle& triangle : meshBoundary(mesh).triangles)
    for (const std::int32_t node : triangle) kinds[static_cast<std::size_t>(node)] = NodeKind::Boundary;
  return kinds;
}

}  // namespace

TissueMesh readMesh(const std::filesystem::path& file, const ReadMeshOptions& options) try {
  requireReadable(file);
  const MeshFormatRow* row = findMeshFormatRow(file.filename().string());
  if (row == nullptr || row->read == nullptr)
    fail(file, "unknown kind of mesh; " + meshExtensions(&MeshFormat::readable) + " can be read");
  TissueMesh mesh = row->read(file, options);
  if (mesh.mesh.tets.empty()) fail(file, "has no tetrahedra");
  mesh.mesh.kinds = kindsOf(mesh.mesh);
  return mesh;
} catch (const std::bad_alloc&) {
  fail(file, "needs more memory than there is");
}

}  // namespace sinew
