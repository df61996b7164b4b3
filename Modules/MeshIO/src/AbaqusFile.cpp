#include "AbaqusFile.h"

#include "CoordinatesNote.h"
#include "LegalNames.h"
#include "SolverMesh.h"
#include "TextWriter.h"

namespace sinew {
namespace {

constexpr int kDigits = 12;
constexpr std::size_t kPerLine = 16;       // Abaqus takes no more
constexpr std::size_t kLongestEnding = 9;  // _boundary
constexpr NameRule kAbaqusNames{.maxBytes = 80 - kLongestEnding,
                                .refused = " !\"#$%&'()*+,./:;<=>?@[\\]^`{|}~",
                                .asciiOnly = true,
                                .letterFirst = true};
const std::vector<std::string> kTaken{"eall"};

/// The number of a face by the corner opposite to it: S1 is 1 2 3, S2 1 4 2, S3 2 4 3, S4 3 4 1.
constexpr std::array<int, 4> kAbaqusFace{3, 4, 2, 1};

/// Numbers of nodes or elements, counted from 1, some in a line.
void writeNumbers(TextWriter& text, const std::vector<std::int32_t>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool lineEnds = i % kPerLine == kPerLine - 1 || i + 1 == numbers.size();
    text << numbers[i] + 1 << (lineEnds ? "\n" : ",");
  }
}

void writeAbaqusNodes(TextWriter& text, const SolverMesh& mesh) {
  text << "*NODE, NSET=Nall\n";
  for (std::size_t n = 0; n < mesh.nodeCount(); ++n) {
    const Eigen::Vector3d x = mesh.node(n);
    text << n + 1;
    for (int axis = 0; axis < 3; ++axis) (text << ',').rounded(x[axis], kDigits);
    text << '\n';
  }
}

void writeElements(TextWriter& text, const SolverMesh& mesh, const SolverPart& part,
                   const std::string& name) {
  text << "** tissue " << part.region->label << ": " << inComment(part.region->name) << '\n';
  text << "*ELEMENT, TYPE=" << (mesh.quadratic() ? "C3D10" : "C3D4") << ", ELSET=" << name << '\n';
  for (const std::int32_t t : part.tets) {
    text << t + 1;
    for (const std::int32_t node : mesh.tet(static_cast<std::size_t>(t))) text << ',' << node + 1;
    text << '\n';
  }
}

void writeSets(TextWriter& text, const SolverPart& part, const std::string& name) {
  text << "*NSET, NSET=" << name << "_nodes\n";
  writeNumbers(text, part.nodes);
  text << "*NSET, NSET=" << name << "_boundary\n";
  writeNumbers(text, part.boundaryNodes);
  text << "*SURFACE, NAME=" << name << "_surface, TYPE=ELEMENT\n";
  for (const TetFace& face : part.boundary) text << face.tet + 1 << ",S" << kAbaqusFace[face.face] << '\n';
}

}  // namespace

void writeAbaqus(const TissueMesh& tissues, const std::filesystem::path& file,
                 const WriteMeshOptions& options) {
  const SolverMesh mesh(tissues, options);
  const std::vector<std::string> names = legalNames(mesh.regions(), kAbaqusNames, kTaken);
  TextWriter text(file);
  text << "** " << coordinatesNote(options) << '\n';
  writeAbaqusNodes(text, mesh);
  for (std::size_t p = 0; p < names.size(); ++p) writeElements(text, mesh, mesh.parts()[p], names[p]);
  text << "*ELSET, ELSET=Eall\n";
  for (const std::string& name : names) text << name << '\n';
  for (std::size_t p = 0; p < names.size(); ++p) writeSets(text, mesh.parts()[p], names[p]);
  text.finish();
}

}  // namespace sinew
