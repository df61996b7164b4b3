#include "BinaryText.h"
#include "MeshFormatTable.h"
#include "Regions.h"
#include "SurfaceWriters.h"
#include "TextWriter.h"
#include "TissueSurfaces.h"

namespace sinew {
namespace {

void writeHeader(TextWriter& out, const std::vector<TissueSurface>& surfaces,
                 const WriteMeshOptions& options) {
  std::size_t nodes = 0, triangles = 0;
  for (const TissueSurface& tissue : surfaces) {
    nodes += tissue.surface.nodes.size();
    triangles += tissue.surface.triangles.size();
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment Sinew\n";
  if (saysSpace(options)) out << "comment SPACE=" << std::string_view(toString(options.space)) << '\n';
  out << "element vertex " << nodes << "\nproperty double x\nproperty double y\nproperty double z\n";
  out << "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\n";
  out << "element face " << triangles << "\nproperty list uchar int vertex_indices\nend_header\n";
}

void writeNodes(TextWriter& out, const TissueSurface& tissue) {
  const ColorBytes color = toBytes(tissue.region->color);
  for (const Eigen::Vector3d& node : tissue.surface.nodes) {
    for (const double& number : node) out << bytesOf(number);
    out << bytesOf(color) << bytesOf(tissue.region->label);
  }
}

void writeFaces(TextWriter& out, const TissueSurface& tissue, std::int32_t firstNode) {
  constexpr std::uint8_t kCorners = 3;
  for (const Triangle& triangle : tissue.surface.triangles) {
    out << bytesOf(kCorners);
    for (const std::int32_t node : triangle) out << bytesOf(firstNode + node);
  }
}

}  // namespace

void writePly(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options) {
  const std::vector<TissueSurface> surfaces = tissueSurfaces(mesh, options);
  TextWriter out(file);
  writeHeader(out, surfaces, options);
  for (const TissueSurface& tissue : surfaces) writeNodes(out, tissue);
  std::int32_t firstNode = 0;
  for (const TissueSurface& tissue : surfaces) {
    writeFaces(out, tissue, firstNode);
    firstNode += static_cast<std::int32_t>(tissue.surface.nodes.size());
  }
  out.finish();
}

}  // namespace sinew
