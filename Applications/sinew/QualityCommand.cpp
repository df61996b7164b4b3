#include "BarChart.h"
#include "CommandLine.h"
#include "MeshSettings.h"
#include "TextTable.h"
#include "commands.h"
#include "sinew/Pipeline/Report.h"
#include "sinew/Segmentation/ReadSegmentation.h"

namespace sinew {
namespace {

struct QualityCommand {
  std::vector<std::string> meshes;
  std::string reference, tissue;
  bool histogram = false;
  ReadSegmentationOptions reading;
  Smoothing smoothing;
};

std::vector<MeshAssessment> assess(const QualityCommand& command) {
  std::vector<MeshAssessment> assessments;
  if (command.reference.empty()) {
    for (const std::string& mesh : command.meshes) assessments.push_back(assessMesh(mesh));
    return assessments;
  }
  const Segmentation reference = readSegmentation(command.reference, command.reading);
  for (const std::string& mesh : command.meshes)
    assessments.push_back(assessMesh(mesh, reference, command.tissue, command.smoothing));
  return assessments;
}

TextTable::Cell violations(std::int64_t count) {
  return {std::to_string(count), count > 0 ? Tone::Bad : Tone::Plain};
}

TextTable qualityTable(const std::vector<MeshAssessment>& assessments) {
  TextTable table({{"mesh", Align::Left},
                   {"tets"},
                   {"nodes"},
                   {"max AR"},
                   {"mean AR"},
                   {"dihedral, deg"},
                   {"edges"},
                   {"inverted"},
                   {"T1"},
                   {"T2"},
                   {"T3"},
                   {"components"},
                   {"Euler"}});
  for (const MeshAssessment& mesh : assessments) {
    const MeshQuality& quality = mesh.quality;
    const MeshConditions& conditions = mesh.conditions;
    table.add(
        {mesh.file, grouped(quality.tets), grouped(quality.nodes), fixed(quality.maxAspectRatio, 2),
         fixed(quality.meanAspectRatio, 2),
         fixed(quality.minDihedralDeg, 1) + " - " + fixed(quality.maxDihedralDeg, 1),
         fixed(quality.maxOverMinEdge, 1), violations(quality.inverted),
         violations(conditions.facesOfManyTets + conditions.nonmanifoldEdges + conditions.nonmanifoldNodes),
         violations(conditions.tetsWithFourBoundaryNodes),
         violations(conditions.interiorEdgesBetweenBoundaryNodes +
                    conditions.interiorFacesWithThreeBoundaryNodes),
         std::to_string(mesh.topology.components), std::to_string(mesh.topology.eulerCharacteristic)});
  }
  return table;
}

TextTable fidelityTable(const std::vector<MeshAssessment>& assessments) {
  TextTable table({{"mesh", Align::Left},
                   {"tissue", Align::Left},
                   {"volume, mm^3"},
                   {"of label, %"},
                   {"Dice"},
                   {"surface rms, mm"},
                   {"max, mm"},
                   {"lost pieces"},
                   {"mm^3"}});
  for (const MeshAssessment& mesh : assessments) {
    const Fidelity& fidelity = *mesh.fidelity;
    table.add({mesh.file, mesh.tissue, fixed(fidelity.volume, 1),
               fixed(100 * fidelity.volume / fidelity.labelVolume, 2), fixed(fidelity.dice, 4),
               fixed(fidelity.surfaceRms, 4), fixed(fidelity.surfaceMax, 4),
               std::to_string(mesh.lost.components), fixed(mesh.lost.volume, 2)});
  }
  return table;
}

BarChart dihedralChart(const QualityHistogram& histogram) {
  BarChart chart{"dihedral, deg", {}};
  for (std::size_t bin = 0; bin < kDihedralBins; ++bin) {
    const double from = kDihedralBinDeg * static_cast<double>(bin);
    chart.bars.push_back(
        {fixed(from, 0) + " - " + fixed(from + kDihedralBinDeg, 0), histogram.dihedrals[bin]});
  }
  return chart;
}

BarChart aspectRatioChart(const QualityHistogram& histogram) {
  BarChart chart{"aspect ratio", {}};
  for (std::size_t bin = 0; bin < kAspectRatioBins.size(); ++bin) {
    const bool open = bin + 1 == kAspectRatioBins.size();
    chart.bars.push_back(
        {fixed(kAspectRatioBins[bin], 2) + " - " + (open ? "" : fixed(kAspectRatioBins[bin + 1], 2)),
         histogram.aspectRatios[bin]});
  }
  return chart;
}

void printHistograms(const std::vector<MeshAssessment>& assessments) {
  for (const MeshAssessment& mesh : assessments) {
    std::cout << '\n';
    if (assessments.size() > 1) std::cout << printable(mesh.file) << '\n';
    dihedralChart(mesh.histogram).print(std::cout);
    std::cout << '\n';
    aspectRatioChart(mesh.histogram).print(std::cout);
  }
}

int quality(const CommandLine& line, const QualityCommand& command) {
  const std::vector<MeshAssessment> assessments = assess(command);
  line.writeJson(toJson(assessments));
  if (line.common.jsonOnStdout()) return 0;
  qualityTable(assessments).print(std::cout);
  if (!command.reference.empty()) {
    std::cout << '\n';
    fidelityTable(assessments).print(std::cout);
  }
  if (command.histogram || assessments.size() == 1) printHistograms(assessments);
  return 0;
}

}  // namespace

int runQuality(const std::vector<std::string>& arguments) {
  CommandLine line("quality",
                   "Measures tetrahedral meshes, and compares them with the tissues they were made from.");
  QualityCommand command;
  CLI::App& app = line.app;
  app.add_option("MESH", command.meshes, "meshes: .vtu, .vtk")->required();
  CLI::Option* reference =
      app.add_option("--reference", command.reference, "segmentation to compare with")->type_name("INPUT");
  app.add_option("--tissue,--label", command.tissue,
                 "tissue of the reference; default: by file name, else by label")
      ->type_name("NAME|LABEL")
      ->needs(reference);
  addOption(app, lutOption(command.reading))->needs(reference);
  addOption(app, fractionalOption(command.reading))->needs(reference);
  addOption(app, smoothingOption(command.smoothing));
  app.add_flag("--histogram", command.histogram,
               "show how dihedral angles and aspect ratios are spread; by default for a single mesh");
  app.footer(
      "T1: boundary edges and nodes where the boundary is no manifold; T2: tets with four boundary nodes;\n"
      "T3: interior edges and faces with all nodes on the boundary; edges: longest over shortest.");
  return line.run(arguments, [&] { return quality(line, command); });
}

}  // namespace sinew
