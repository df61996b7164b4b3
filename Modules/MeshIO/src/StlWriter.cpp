#include "BinaryText.h"
#include "MeshFormatTable.h"
#include "SurfaceWriters.h"
#include "TextWriter.h"
#include "TissueSurfaces.h"

#include <Eigen/Geometry>

namespace sinew {
namespace {

/// Not `solid`, by which readers know the other form.
std::string header(const WriteMeshOptions& options) {
  std::string text = "Sinew";
  if (saysSpace(options)) text.append(" SPACE=").append(toString(options.space));
  text.resize(80, ' ');
  return text;
}

void writeFacet(TextWriter& out, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a).normalized().cast<float>();
  constexpr std::uint16_t kFree = 0;
  for (const Eigen::Vector3f& x : {normal, Eigen::Vector3f(a.cast<float>()), Eigen::Vector3f(b.cast<float>()),
                                   Eigen::Vector3f(c.cast<float>())})
    for (const float& number : x) out << bytesOf(number);
  out << bytesOf(kFree);
}

}  // namespace

void writeStl(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options) {
  const std::vector<TissueSurface> surfaces = tissueSurfaces(mesh, options);
  std::uint32_t facets = 0;
  for (const TissueSurface& tissue : surfaces)
    facets += static_cast<std::uint32_t>(tissue.surface.triangles.size());
  TextWriter out(file);
  out << header(options) << bytesOf(facets);
  for (const TissueSurface& tissue : surfaces)
    for (const auto& [a, b, c] : tissue.surface.triangles)
      writeFacet(out, tissue.surface.nodes[a], tissue.surface.nodes[b], tissue.surface.nodes[c]);
  out.finish();
}

}  // namespace sinew
