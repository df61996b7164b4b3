#include "sinew/MeshIO/TriangleFile.h"

#include "GuardedXmlReader.h"
#include "ObjFile.h"
#include "PlyFile.h"
#include "StlFile.h"
#include "VtkReading.h"

#include <vtkCellArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <new>
#include <numeric>
#include <string_view>
#include <tuple>

namespace sinew {
namespace {

namespace fs = std::filesystem;

std::vector<Triangle> trianglesOf(vtkPolyData* polygons, std::size_t nodes, const fs::path& file) {
  std::vector<Triangle> triangles;
  vtkCellArray* cells = polygons->GetPolys();
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(cell, size, corners);
    if (std::any_of(corners, corners + size,
                    [&](vtkIdType n) { return n < 0 || static_cast<std::size_t>(n) >= nodes; }))
      fail(file, "polygon " + std::to_string(cell) + " names a node that is not there");
    const auto corner = [&](vtkIdType k) { return static_cast<std::int32_t>(corners[k]); };
    for (vtkIdType k = 2; k < size; ++k) triangles.push_back({corner(0), corner(k - 1), corner(k)});
  }
  return triangles;
}

TriangleMesh readVtp(const fs::path& file) {
  const auto reader = vtkSmartPointer<GuardedXmlReader<vtkXMLPolyDataReader>>::New();
  reader->SetFileName(file.c_str());
  update(reader, file, "a surface mesh");
  TriangleMesh mesh{nodesOf(reader->GetOutput(), file), {}};
  mesh.triangles = trianglesOf(reader->GetOutput(), mesh.nodes.size(), file);
  return mesh;
}

/// VTK 9.1 also reads the others, but crashes on damaged ones.
struct Format {
  std::string_view extension;
  TriangleMesh (*read)(const fs::path&);
};
constexpr std::array<Format, 4> kFormats{
    {{".obj", &readObj}, {".ply", &readPly}, {".stl", &readStl}, {".vtp", &readVtp}}};

TriangleMesh readPolygons(const fs::path& file) {
  requireReadable(file);
  const auto format = std::ranges::find(kFormats, file.extension().string(), &Format::extension);
  if (format == kFormats.end())
    fail(file, "unknown kind of surface mesh; .obj, .ply, .stl and .vtp can be read");
  return format->read(file);
}

/// Gives points at the same place one number, that of the first, and drops triangles that then name it twice.
void weld(TriangleMesh& mesh) {
  const auto place = [&](std::int32_t n) {
    const Eigen::Vector3d& x = mesh.nodes[n];
    return std::tuple(x.x(), x.y(), x.z());
  };
  std::vector<std::int32_t> order(mesh.nodes.size()), first(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::int32_t n) { return std::tuple_cat(place(n), std::tuple(n)); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  for (Triangle& triangle : mesh.triangles)
    for (std::int32_t& node : triangle) node = first[node];
  std::erase_if(mesh.triangles, [](const Triangle& t) {
    const auto& [a, b, c] = t;
    return a == b || b == c || c == a;
  });
}

void dropUnusedNodes(TriangleMesh& mesh) {
  std::vector<std::int32_t> number(mesh.nodes.size(), -1);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::int32_t node : triangle) number[node] = 0;
  std::int32_t used = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    mesh.nodes[used] = mesh.nodes[n];
    number[n] = used++;
  }
  mesh.nodes.resize(used);
  for (Triangle& triangle : mesh.triangles)
    for (std::int32_t& node : triangle) node = number[node];
}

}  // namespace

TriangleMesh readTriangleMesh(const fs::path& file) try {
  TriangleMesh mesh = readPolygons(file);
  weld(mesh);
  if (mesh.triangles.empty()) fail(file, "has no polygons");
  dropUnusedNodes(mesh);
  return mesh;
} catch (const std::bad_alloc&) {
  fail(file, "needs more memory than there is");
}

}  // namespace sinew
