#include "MeshFormatTable.h"
#include "SurfaceWriters.h"
#include "TextWriter.h"
#include "TissueSurfaces.h"

#include <algorithm>

namespace sinew {
namespace {

/// White space would end the name, a backslash at its end the line.
std::string groupName(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c <= ' ' || c == 0x7f || c == '\\'; }, '_');
  return name.empty() ? "_" : name;
}

void writeGroup(TextWriter& out, const TissueSurface& tissue, std::size_t nodesBefore) {
  out << "g " << groupName(tissue.region->name) << '\n';
  for (const Eigen::Vector3d& x : tissue.surface.nodes)
    out << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  const auto number = [&](std::int32_t node) { return nodesBefore + static_cast<std::size_t>(node) + 1; };
  for (const auto& [a, b, c] : tissue.surface.triangles)
    out << "f " << number(a) << ' ' << number(b) << ' ' << number(c) << '\n';
}

}  // namespace

void writeObj(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options) {
  TextWriter out(file);
  out << "# Sinew\n";
  if (saysSpace(options)) out << "# SPACE=" << std::string_view(toString(options.space)) << '\n';
  std::size_t nodesBefore = 0;
  for (const TissueSurface& tissue : tissueSurfaces(mesh, options)) {
    writeGroup(out, tissue, nodesBefore);
    nodesBefore += tissue.surface.nodes.size();
  }
  out.finish();
}

}  // namespace sinew
