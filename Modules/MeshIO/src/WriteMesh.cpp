#include "sinew/MeshIO/WriteMesh.h"

#include "FileFailure.h"
#include "MeshFormatTable.h"
#include "Regions.h"

#include <set>

namespace sinew {
namespace {

namespace fs = std::filesystem;

void checkSize(const std::string& name, std::size_t values, std::size_t wanted, const char* of) {
  if (values != wanted)
    throw std::invalid_argument("writeMesh: " + std::to_string(values) + " " + name + " for " +
                                std::to_string(wanted) + " " + of);
}

void checkSizes(const TissueMesh& mesh) {
  checkSize("labels", mesh.mesh.labels.size(), mesh.mesh.tets.size(), "tets");
  for (const MeshArray& array : mesh.arrays.cells)
    checkSize(array.name, array.values.size(), array.components * mesh.mesh.tets.size(), "tets");
  for (const MeshArray& array : mesh.arrays.points)
    checkSize(array.name, array.values.size(), array.components * mesh.mesh.nodes.size(), "nodes");
}

/// Regions for the labels that have none.
std::vector<TissueRegion> missingRegions(const TissueMesh& mesh) {
  std::set<std::int32_t> missing(mesh.mesh.labels.begin(), mesh.mesh.labels.end());
  for (const TissueRegion& region : mesh.regions) missing.erase(region.label);
  std::vector<TissueRegion> regions;
  for (const std::int32_t label : missing) regions.push_back(unnamedRegion(label));
  return regions;
}

void writeComplete(const MeshFormatRow& row, const TissueMesh& mesh, const fs::path& file,
                   const WriteMeshOptions& options) {
  const std::vector<TissueRegion> missing = missingRegions(mesh);
  if (missing.empty()) return row.write(mesh, file, options);
  TissueMesh complete = mesh;
  complete.regions.insert(complete.regions.end(), missing.begin(), missing.end());
  row.write(complete, file, options);
}

}  // namespace

void writeMesh(const TissueMesh& mesh, const fs::path& file, const WriteMeshOptions& options) {
  checkSizes(mesh);
  const MeshFormatRow* row = findMeshFormatRow(file.filename().string());
  if (row == nullptr) fail(file, "unknown kind of mesh file; known are " + meshExtensions());
  const bool replaceable = !fs::exists(file) || fs::is_regular_file(file);
  const fs::path partial = replaceable ? fs::path(file).concat(".partial") : file;
  try {
    writeComplete(*row, mesh, partial, options);
    if (replaceable) fs::rename(partial, file);
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    if (replaceable) fs::remove(partial, ignored);
    fail(file, std::string("cannot be written (") + error.what() + ")");
  }
}

}  // namespace sinew
