#include "sinew/MeshIO/ReadMesh.h"

#include "FileFailure.h"
#include "MeshFormatTable.h"

#include <new>

namespace sinew {

TissueMesh readMesh(const std::filesystem::path& file) try {
  requireReadable(file);
  const MeshFormatRow* row = findMeshFormatRow(file.filename().string());
  if (row == nullptr || row->read == nullptr)
    fail(file, "unknown kind of mesh; " + meshExtensions(true) + " can be read");
  return row->read(file);
} catch (const std::bad_alloc&) {
  fail(file, "needs more memory than there is");
}

}  // namespace sinew
