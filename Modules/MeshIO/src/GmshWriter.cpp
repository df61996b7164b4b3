#include "CoordinatesNote.h"
#include "GmshFile.h"
#include "LegalNames.h"
#include "SolverMesh.h"
#include "TextWriter.h"

#include <algorithm>

namespace sinew {
namespace {

// The manual allows 127 bytes; FEBio Studio's reader writes behind its buffer beyond.
constexpr std::string_view kBoundarySuffix = " boundary";
constexpr NameRule kGmshNames{.maxBytes = 127 - kBoundarySuffix.size(), .refused = "\""};

enum GmshElement { kTriangle3 = 2, kTetrahedron4 = 4, kTriangle6 = 9, kTetrahedron10 = 11 };
/// The places of Gmsh's nodes in a QuadraticTet.
constexpr std::array<int, 10> kGmshOrder{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

void writeNames(TextWriter& text, const std::vector<std::string>& names,
                const std::vector<std::int32_t>& tags) {
  constexpr int kSurface = 2, kVolume = 3;
  text << "$PhysicalNames\n" << 2 * names.size() << '\n';
  for (std::size_t p = 0; p < names.size(); ++p)
    text << kSurface << ' ' << tags[p] << " \"" << names[p] << kBoundarySuffix << "\"\n";
  for (std::size_t p = 0; p < names.size(); ++p)
    text << kVolume << ' ' << tags[p] << " \"" << names[p] << "\"\n";
  text << "$EndPhysicalNames\n";
}

void writeGmshNodes(TextWriter& text, const SolverMesh& mesh) {
  text << "$Nodes\n" << mesh.nodeCount() << '\n';
  for (std::size_t n = 0; n < mesh.nodeCount(); ++n) {
    const Eigen::Vector3d x = mesh.node(n);
    text << n + 1 << ' ' << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  }
  text << "$EndNodes\n";
}

void writeGmshElements(TextWriter& text, const SolverMesh& mesh, const std::vector<std::int32_t>& tags) {
  std::vector<std::int32_t> tagOf(mesh.tetCount());
  std::size_t elements = mesh.tetCount();
  for (std::size_t p = 0; p < tags.size(); ++p) {
    for (const std::int32_t t : mesh.parts()[p].tets) tagOf[t] = tags[p];
    elements += mesh.parts()[p].boundary.size();
  }
  text << "$Elements\n" << elements << '\n';
  std::size_t number = 0;
  const auto begin = [&](GmshElement type, std::int32_t tag) {
    text << ++number << ' ' << int{type} << " 2 " << tag << ' ' << tag;
  };
  for (std::size_t t = 0; t < mesh.tetCount(); ++t) {
    begin(mesh.quadratic() ? kTetrahedron10 : kTetrahedron4, tagOf[t]);
    const auto nodes = mesh.tet(t);
    for (std::size_t k = 0; k < nodes.size(); ++k) text << ' ' << nodes[kGmshOrder[k]] + 1;
    text << '\n';
  }
  for (std::size_t p = 0; p < tags.size(); ++p)
    for (const TetFace& face : mesh.parts()[p].boundary) {
      begin(mesh.quadratic() ? kTriangle6 : kTriangle3, tags[p]);
      for (const std::int32_t node : mesh.face(face)) text << ' ' << node + 1;
      text << '\n';
    }
  text << "$EndElements\n";
}

}  // namespace

void writeGmsh(const TissueMesh& tissues, const std::filesystem::path& file,
               const WriteMeshOptions& options) {
  const SolverMesh mesh(tissues, options);
  const std::vector<std::int32_t> tags = mesh.tags();
  TextWriter text(file);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  writeNames(text, legalNames(mesh.regions(), kGmshNames), tags);
  writeGmshNodes(text, mesh);
  writeGmshElements(text, mesh, tags);
  text << "$Comments\n" << coordinatesNote(options) << "\n$EndComments\n";
  text.finish();
}

}  // namespace sinew
