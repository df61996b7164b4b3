#include "ConvertCommand.h"
#include "JsonReport.h"
#include "TextTable.h"
#include "sinew/MeshIO/CombineMeshes.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Pipeline/OutputFile.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;

/// OUT, with the extension of the preset where it has none of a mesh.
std::string outputOf(const ConvertCommand& command) {
  if (findMeshFormat(fs::path(command.output).filename().string()) != nullptr) return command.output;
  if (!command.files.preset.empty()) return command.output + std::string(standardExtension(command.files));
  throw CLI::ValidationError("OUT",
                             command.output + ": unknown kind of mesh file; known are " + meshExtensions());
}

std::string stemOf(const std::string& file) {
  const std::string name = fs::path(file).filename().string();
  const MeshFormat* format = findMeshFormat(name);
  return name.substr(0, name.size() - format->extension.size());
}

/// Whether readMesh had to invent it.
bool isNameless(const TissueRegion& region) {
  return region.name.empty() || region.name == "Segment_" + std::to_string(region.label);
}

/// A mesh in which every label has a region with a name: that of its file where it had none.
TissueMesh readNamed(const std::string& file) {
  TissueMesh mesh = readMesh(file);
  std::map<std::int32_t, std::int64_t> tets;
  for (const std::int32_t label : mesh.mesh.labels) ++tets[label];
  for (const auto& [label, count] : tets)
    if (std::ranges::count(mesh.regions, label, &TissueRegion::label) == 0)
      mesh.regions.push_back({label, {}});
  for (TissueRegion& region : mesh.regions)
    if (isNameless(region))
      region.name =
          mesh.regions.size() == 1 ? stemOf(file) : stemOf(file) + "_" + std::to_string(region.label);
  return mesh;
}

TissueMesh readAll(const std::vector<std::string>& files) {
  std::vector<TissueMesh> meshes;
  for (const std::string& file : files) meshes.push_back(readNamed(file));
  return combineMeshes(std::move(meshes));
}

std::map<std::int32_t, std::int64_t> tetsByLabel(const TetMesh& mesh) {
  std::map<std::int32_t, std::int64_t> tets;
  for (const std::int32_t label : mesh.labels) ++tets[label];
  return tets;
}

void print(std::ostream& stream, const std::string& output, const TissueMesh& mesh,
           const std::optional<CurvedBoundary>& curved) {
  TextTable table({{"label"}, {"tissue", Align::Left}, {"tets"}});
  const std::map<std::int32_t, std::int64_t> tets = tetsByLabel(mesh.mesh);
  for (const TissueRegion& region : mesh.regions)
    table.add({std::to_string(region.label), printable(region.name), grouped(tets.at(region.label))});
  table.print(stream);
  stream << '\n' << output << ": " << grouped(std::ssize(mesh.mesh.tets)) << " tets\n";
  if (curved)
    stream << grouped(std::ssize(curved->edges)) << " of " << grouped(curved->boundaryEdges)
           << " edges of the boundary bend; so that tets stay valid, " << grouped(curved->pulledBackEdges)
           << " of them less than the surface, and " << grouped(curved->straightenedEdges)
           << " more not at all\n";
}

Json toJson(const ConvertCommand& command, const std::string& output, const TissueMesh& mesh,
            const WriteMeshOptions& options, const std::optional<CurvedBoundary>& curved) {
  Json json = programFields();
  json["kind"] = "mesh";
  json["inputs"] = command.inputs;
  json["output"] = output;
  json["unit"] = unitOf(options);
  json["space"] = options.space == Space::Ras ? "RAS" : "LPS";
  json["nodes"] = mesh.mesh.nodes.size();
  json["tets"] = mesh.mesh.tets.size();
  json["regions"] = Json::array();
  const std::map<std::int32_t, std::int64_t> tets = tetsByLabel(mesh.mesh);
  for (const TissueRegion& region : mesh.regions)
    json["regions"].push_back({{"name", region.name},
                               {"label", region.label},
                               {"color", region.color},
                               {"tets", tets.at(region.label)}});
  if (curved)
    json["curved_edges"] = {{"boundary_edges", curved->boundaryEdges},
                            {"bent", curved->edges.size()},
                            {"pulled_back", curved->pulledBackEdges},
                            {"straightened", curved->straightenedEdges},
                            {"at_creases", curved->awayEdges}};
  return json;
}

}  // namespace

std::string convertMeshes(const CommandLine& line, const ConvertCommand& command) {
  const WriteMeshOptions options = resolved(command.files);
  const std::string target = outputOf(command);
  checkOutputFile(target, line.common.force);
  TissueMesh mesh = readAll(command.inputs);
  std::optional<CurvedBoundary> curved;
  if (options.quadratic) {
    curved = curveBoundary(mesh.mesh);
    mesh.curvedEdges = curved->edges;
  }
  const OutputFolder folder(fs::absolute(target).parent_path());
  OutputFile output(target);
  writeMesh(mesh, output.temporary(), options);
  output.commit();
  if (std::ostream* stream = line.tables()) print(*stream, target, mesh, curved);
  return document(toJson(command, target, mesh, options, curved));
}

}  // namespace sinew
