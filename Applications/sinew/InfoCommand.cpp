#include "CommandLine.h"
#include "FileKind.h"
#include "MeshInfo.h"
#include "MeshSettings.h"
#include "TextTable.h"
#include "commands.h"
#include "sinew/Pipeline/Report.h"
#include "sinew/Segmentation/LabelComponents.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <iostream>

namespace sinew {
namespace {

std::string triple(const Eigen::Vector3d& v, int decimals, const char* separator) {
  return fixed(v.x(), decimals) + separator + fixed(v.y(), decimals) + separator + fixed(v.z(), decimals);
}

void printGeometry(std::ostream& stream, const Segmentation& segmentation) {
  const ImageGeometry& geometry = segmentation.geometry;
  stream << segmentation.source << "\n  size       " << geometry.size.x() << " x " << geometry.size.y()
         << " x " << geometry.size.z() << " voxels";
  if (segmentation.layers.size() > 1) stream << ", " << segmentation.layers.size() << " layers";
  stream << "\n  spacing    " << triple(geometry.spacing, 4, " x ") << " mm\n  origin     "
         << triple(geometry.origin, 3, ", ") << " mm (LPS)\n";
  for (int axis = 0; axis < 3; ++axis)
    stream << "  axis "
           << "ijk"[axis] << "     " << triple(geometry.direction.col(axis), 5, ", ") << '\n';
  stream << "  voxel      " << fixed(geometry.voxelVolume(), 5)
         << " mm^3; 1vox = " << fixed(geometry.meanSpacing(), 4) << " mm\n";
}

void printTissues(std::ostream& stream, const Segmentation& segmentation,
                  const std::vector<std::int64_t>& pieces) {
  TextTable table({{"label"},
                   {"layer"},
                   {"name", Align::Left},
                   {"colour", Align::Left},
                   {"voxels"},
                   {"mm^3"},
                   {"pieces"}});
  for (std::size_t t = 0; t < segmentation.tissues.size(); ++t) {
    const Tissue& tissue = segmentation.tissues[t];
    table.add({std::to_string(tissue.label), std::to_string(tissue.layer), tissue.name,
               colourCode(tissue.color), grouped(tissue.voxels),
               fixed(static_cast<double>(tissue.voxels) * segmentation.geometry.voxelVolume(), 1),
               grouped(pieces[t])});
  }
  table.print(stream);
  for (const Tissue& tissue : segmentation.emptyTissues)
    stream << "without a voxel: " << printable(tissue.name) << '\n';
}

int infoOnMesh(const CommandLine& line, const std::string& input) {
  const MeshInfo mesh = describeMesh(input);
  line.writeJson(toJson(mesh));
  if (!line.common.jsonOnStdout()) print(std::cout, mesh);
  return 0;
}

int info(const CommandLine& line, const std::string& input, const ReadSegmentationOptions& options) {
  if (fileKind(input) == FileKind::Mesh) return infoOnMesh(line, input);
  const Segmentation segmentation = readSegmentation(input, options);
  line.printWarnings(segmentation);
  std::vector<std::int64_t> pieces;
  for (const Tissue& tissue : segmentation.tissues)
    pieces.push_back(static_cast<std::int64_t>(labelComponents(segmentation, tissue).voxels.size()));
  line.writeJson(toJson(segmentation, pieces));
  if (line.common.jsonOnStdout()) return 0;
  printGeometry(std::cout, segmentation);
  std::cout << '\n';
  printTissues(std::cout, segmentation, pieces);
  return 0;
}

}  // namespace

int runInfo(const std::vector<std::string>& arguments) {
  CommandLine line("info", "Shows what is in a segmentation or a mesh: geometry and tissues.");
  std::string input;
  ReadSegmentationOptions options;
  line.app.add_option("INPUT", input, "segmentation, DICOM SEG or mesh")->required();
  addOption(line.app, lutOption(options));
  addOption(line.app, fractionalOption(options));
  return line.run(arguments, [&] { return info(line, input, options); });
}

}  // namespace sinew
