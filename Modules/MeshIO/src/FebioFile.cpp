#include "FebioFile.h"

#include "CoordinatesNote.h"
#include "LegalNames.h"
#include "SolverMesh.h"
#include "TextWriter.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

/// FEBio Studio copies names into 256 bytes. Comma, colon, dot, at and brackets mean something where sets are
/// named.
constexpr NameRule kFebioNames{.maxBytes = 200, .refused = "\"&'<>,:.@[]"};

struct UnitSystem {
  double perMm;
  const char* name;
};
constexpr std::array<UnitSystem, 3> kUnitSystems{{{1, "mm-N-s"}, {0.1, "CGS"}, {0.001, "SI"}}};

/// A comment must not hold two hyphens in a row, nor end in one.
std::string xmlComment(const std::string& text) {
  std::string comment;
  for (const char c : inComment(text)) comment += c == '-' && comment.ends_with('-') ? ' ' : c;
  return "<!-- " + comment + " -->";
}

void writeModule(TextWriter& text, double perMm) {
  const auto system = std::ranges::find(kUnitSystems, perMm, &UnitSystem::perMm);
  text << "  <Module type=\"solid\">\n";
  if (system != kUnitSystems.end()) text << "    <units>" << system->name << "</units>\n";
  text << "  </Module>\n";
}

void writeMaterials(TextWriter& text, const SolverMesh& mesh, const std::vector<std::string>& names) {
  text << "  <Material>\n    <!-- a mesh knows no materials: set your own -->\n";
  for (std::size_t p = 0; p < names.size(); ++p) {
    const TissueRegion& region = *mesh.parts()[p].region;
    text << "    " << xmlComment("tissue " + std::to_string(region.label) + ": " + region.name) << '\n';
    text << "    <material id=\"" << p + 1 << "\" name=\"" << names[p] << "\" type=\"neo-Hookean\">\n"
         << "      <density>1</density>\n      <E>1</E>\n      <v>0.3</v>\n    </material>\n";
  }
  text << "  </Material>\n";
}

template <class Nodes>
void writeCell(TextWriter& text, std::string_view tag, std::size_t id, const Nodes& nodes) {
  text << "      <" << tag << " id=\"" << id << "\">";
  const char* separator = "";
  for (const std::int32_t node : nodes) {
    text << separator << node + 1;
    separator = ",";
  }
  text << "</" << tag << ">\n";
}

void writeMeshSection(TextWriter& text, const SolverMesh& mesh, const std::vector<std::string>& names) {
  text << "  <Mesh>\n    <Nodes name=\"All nodes\">\n";
  for (std::size_t n = 0; n < mesh.nodeCount(); ++n) {
    const Eigen::Vector3d x = mesh.node(n);
    text << "      <node id=\"" << n + 1 << "\">" << x.x() << ',' << x.y() << ',' << x.z() << "</node>\n";
  }
  text << "    </Nodes>\n";
  for (std::size_t p = 0; p < names.size(); ++p) {
    text << "    <Elements type=\"" << (mesh.quadratic() ? "tet10" : "tet4") << "\" name=\"" << names[p]
         << "\">\n";
    for (const std::int32_t t : mesh.parts()[p].tets)
      writeCell(text, "elem", static_cast<std::size_t>(t) + 1, mesh.tet(static_cast<std::size_t>(t)));
    text << "    </Elements>\n";
  }
  for (std::size_t p = 0; p < names.size(); ++p) {
    text << "    <Surface name=\"" << names[p] << "_surface\">\n";
    std::size_t id = 0;
    for (const TetFace& face : mesh.parts()[p].boundary)
      writeCell(text, mesh.quadratic() ? "tri6" : "tri3", ++id, mesh.face(face));
    text << "    </Surface>\n";
  }
  text << "  </Mesh>\n";
}

}  // namespace

void writeFebio(const TissueMesh& tissues, const std::filesystem::path& file,
                const WriteMeshOptions& options) {
  const SolverMesh mesh(tissues, options);
  const std::vector<std::string> names = legalNames(mesh.regions(), kFebioNames);
  TextWriter text(file);
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
       << xmlComment(coordinatesNote(options)) << "\n<febio_spec version=\"4.0\">\n";
  writeModule(text, options.perMm);
  writeMaterials(text, mesh, names);
  writeMeshSection(text, mesh, names);
  text << "  <MeshDomains>\n";
  for (const std::string& name : names)
    text << "    <SolidDomain name=\"" << name << "\" mat=\"" << name << "\"/>\n";
  text << "  </MeshDomains>\n</febio_spec>\n";
  text.finish();
}

}  // namespace sinew
